#include "surface/read.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>

#include "support/expect_error.h"
#include "support/outcomes.h"
#include "support/shared_data.h"
#include "support/temporary_folder.h"
#include "surface/generate.h"
#include "surface/write.h"

namespace hexwall {
namespace {

using test::expect_error;

ReadResult read_text(const std::string& name, const std::string& content) {
  const TemporaryFolder folder;
  std::ofstream(folder / name, std::ios::binary) << content;
  return read_surface(folder / name);
}

void expect_read_error(const std::string& name, const std::string& content,
                       std::initializer_list<const char*> words) {
  expect_error(ExitCode::read, words, [&] { read_text(name, content); });
}

bool has_note(const ReadResult& result, const std::string& words) {
  return std::any_of(result.notes.begin(), result.notes.end(), [&](const std::string& note) {
    return note.find(words) != std::string::npos;
  });
}

const std::string two_facets =
    "solid two\n"
    " facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1 0 0\n   vertex 0 1 0\n"
    "  endloop\n endfacet\n"
    " facet normal 0 0 1\n  outer loop\n   vertex 1 0 -0.0\n   vertex 1 1 0\n   vertex 0 1 0\n"
    "  endloop\n endfacet\n"
    "endsolid two\n";

const std::string vtk_square_points =
    "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\n"
    "POINTS 4 double\n0 0 0 1 0 0 1 1 0 0 1 0\n";

// --- errors -------------------------------------------------------------------------------------

TEST(ReadSurface, RefusesMissingFile) {
  expect_error(ExitCode::read, {"/nowhere/vessel.stl", "does not exist"},
               [] { read_surface("/nowhere/vessel.stl"); });
}

TEST(ReadSurface, RefusesDirectory) {
  const TemporaryFolder folder;
  expect_error(ExitCode::read, {"directory"}, [&] { read_surface(folder.path()); });
}

TEST(ReadSurface, RefusesEmptyFile) {
  expect_read_error("a.stl", "", {"a.stl", "empty"});
}

TEST(ReadSurface, RefusesUnknownExtensionAndListsTheKnown) {
  expect_read_error("a.step", "x", {"'.step'", ".stl", ".obj", ".ply", ".off", ".vtp", ".vtk"});
}

TEST(ReadSurface, RefusesTruncatedBinaryStl) {
  const TemporaryFolder folder;
  const auto path = folder / "a.stl";
  write_surface(path, annulus(1, 2, 8, 2));
  std::filesystem::resize_file(path, 1000);
  expect_error(ExitCode::read, {"truncated", "32 triangles", "1684", "1000"},
               [&] { read_surface(path); });
  std::filesystem::resize_file(path, 60);
  expect_error(ExitCode::read, {"truncated", "84"}, [&] { read_surface(path); });
}

TEST(ReadSurface, RefusesTextStlThatEndsInsideAFacet) {
  expect_read_error("a.stl", two_facets.substr(0, 180), {"truncated", "inside a facet"});
}

TEST(ReadSurface, RefusesBadNumbersAndNamesTheLine) {
  std::string content = two_facets;
  content.replace(content.find("1 0 0"), 1, "one");
  expect_read_error("a.stl", content, {"line 5", "'one'"});
}

TEST(ReadSurface, RefusesFilesWithoutTriangles) {
  expect_read_error("a.stl", "solid a\nendsolid a\n", {"no triangles"});
  expect_read_error("a.obj", "v 0 0 0\nl 1 1\n", {"no triangles"});
  expect_read_error("a.off", "OFF\n0 0 0\n", {"no triangles"});
  expect_read_error("a.vtk", vtk_square_points + "LINES 1 3\n2 0 1\n", {"no triangles"});
}

TEST(ReadSurface, RefusesIndicesOutOfRange) {
  const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  expect_read_error("a.obj", points + "f 1 2 4\n", {"out of range", "3 points"});
  expect_read_error("a.obj", points + "f 1 2 0\n", {"out of range"});
  expect_read_error("a.obj", points + "f 1 2 -4\n", {"out of range"});
  expect_read_error("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", {"out of range"});
  expect_read_error("a.vtk", vtk_square_points + "POLYGONS 1 4\n3 0 1 9\n", {"out of range"});
  expect_read_error("a.ply",
                    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                    "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
                    "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n",
                    {"out of range"});
}

TEST(ReadSurface, RefusesFacesWithTwoCorners) {
  expect_read_error("a.obj", "v 0 0 0\nv 1 0 0\nf 1 2\n", {"2 corners"});
}

TEST(ReadSurface, RefusesBadOff) {
  expect_read_error("a.off", "ply\n", {"'OFF'"});
  expect_read_error("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n", {"truncated", "3 points"});
  expect_read_error("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1\n", {"announces 3 corners"});
  expect_read_error("a.off", "OFF BINARY\n", {"binary"});
  expect_read_error("a.off", "4OFF\n", {"space"});
}

TEST(ReadSurface, PassesOnWhatVtkSays) {
  testing::internal::CaptureStderr();
  expect_read_error("a.vtp", "this is no XML", {"a.vtp", "XML"});
  expect_read_error("a.vtk", "this is no VTK file\n", {"a.vtk", "nrecognized"});
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(ReadSurface, RefusesTruncatedFilesOfEachFormat) {
  const TemporaryFolder folder;
  for (const char* name : {"a.stl", "a.off", "a.ply", "a.vtp", "a.vtk"}) {
    for (const double fraction : {0.01, 0.3, 0.6, 0.95}) {
      const auto path = folder / name;
      write_surface(path, annulus(1, 2, 40, 10));
      const auto size = static_cast<double>(std::filesystem::file_size(path));
      std::filesystem::resize_file(path, static_cast<std::uintmax_t>(fraction * size));
      expect_error(ExitCode::read, {name}, [&] { read_surface(path); });
    }
  }
}

const std::string ply_header =
    "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 4\nproperty float x\n"
    "property float y\nproperty float z\nproperty uchar red\nelement face 1\n"
    "property list uchar int vertex_index\nproperty list uchar float texcoord\nend_header\n";

TEST(ReadSurface, PlyTakesTextAndSkipsOtherProperties) {
  const ReadResult result = read_text(
      "a.ply", ply_header + "0 0 0 255\n1 0 0 255\n1 1.5 0 255\n0 1 0 255\n4 0 1 2 3 2 0.5 0.5\n");
  EXPECT_EQ(result.surface.points[2], Vec3(1, 1.5, 0));
  EXPECT_EQ(result.surface.triangles.size(), 2U);
}

TEST(ReadSurface, PlyTakesBigEndian) {
  std::string content = ply_header;
  content.replace(content.find("ascii"), 5, "binary_big_endian");
  content.replace(content.find("vertex 4"), 8, "vertex 3");
  const std::string one("\x3f\x80\x00\x00", 4);
  const std::string zero(4, '\0');
  content += zero + zero + zero + '\x01' + one + zero + zero + '\x01' + zero + one + zero + '\x01';
  content += '\x03' + zero + std::string("\0\0\0\x01\0\0\0\x02\0", 9);
  const ReadResult result = read_text("a.ply", content);
  EXPECT_EQ(result.surface.points, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(result.surface.triangles[0], (std::array<int, 3>{0, 1, 2}));
}

TEST(ReadSurface, RefusesBadPly) {
  const auto changed = [](const std::string& from, const std::string& to) {
    std::string header = ply_header;
    return header.replace(header.find(from), from.size(), to);
  };
  expect_read_error("a.ply", "obj\n", {"'ply'"});
  expect_read_error("a.ply", "ply\nformat ascii 1.0\n", {"truncated", "header"});
  expect_read_error("a.ply", changed("ascii", "roman"), {"format roman", "not understood"});
  expect_read_error("a.ply", changed("float x", "quad x"), {"property quad x"});
  expect_read_error("a.ply", changed("vertex 4", "vertex many"), {"element vertex many"});
  expect_read_error("a.ply", changed("property float x", "property x"), {"property x"});
  expect_read_error("a.ply", changed("comment", "remark"), {"remark"});
  expect_read_error("a.ply", changed("float z", "float w"), {"x, y and z"});
  expect_read_error("a.ply", changed("float z", "float x"), {"'x'", "twice"});
  expect_read_error("a.ply", changed("vertex_index", "edges"), {"no triangles"});
  expect_read_error("a.ply", changed("element face", "element tristrips"), {"strips"});
  expect_read_error("a.ply", ply_header + "0 0 zero 1\n", {"'zero'", "'vertex' number 1 of 4"});
  expect_read_error("a.ply", ply_header + "0 0 0 1\n0 0\n", {"truncated", "number 2 of 4"});
  const std::string points = "0 0 0 1\n1 0 0 1\n1 1 0 1\n0 1 0 1\n";
  expect_read_error("a.ply", ply_header + points + "nan 0 1 2\n", {"a list of nan values"});
}

// --- formats ------------------------------------------------------------------------------------

class Formats : public testing::TestWithParam<const char*> {};

TEST_P(Formats, RoundTripKeepsTheSurface) {
  const TemporaryFolder folder;
  const auto path = folder / (std::string("a") + GetParam());
  const TriangleSurface surface = cylinder(1.0, 3.0, 12, 5);
  write_surface(path, surface);
  const ReadResult result = read_surface(path);
  EXPECT_TRUE(result.notes.empty());
  ASSERT_EQ(result.surface.points.size(), surface.points.size());
  ASSERT_EQ(result.surface.triangles.size(), surface.triangles.size());
  for (std::size_t f = 0; f < surface.triangles.size(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const Vec3& p = surface.points[surface.triangles[f][k]];
      const Vec3& q = result.surface.points[result.surface.triangles[f][k]];
      EXPECT_LT((p - q).norm(), 1e-6);  // single precision
    }
  }
}

INSTANTIATE_TEST_SUITE_P(ReadSurface, Formats,
                         testing::Values(".stl", ".STL", ".obj", ".ply", ".off", ".vtp", ".vtk"));

TEST(ReadSurface, FormatsButStlAreExact) {
  const TemporaryFolder folder;
  const TriangleSurface surface = cylinder(1.0, 3.0, 12, 5);
  for (const char* name : {"a.obj", "a.off", "a.ply", "a.vtp", "a.vtk"}) {
    write_surface(folder / name, surface);
    const TriangleSurface copy = read_surface(folder / name).surface;
    EXPECT_EQ(copy.points, surface.points) << name;
    EXPECT_EQ(copy.triangles, surface.triangles) << name;
  }
}

TEST(ReadSurface, WeldsStlPointsInOrderOfAppearance) {
  const TriangleSurface surface = read_text("a.stl", two_facets).surface;
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  EXPECT_EQ(surface.points, points);
  EXPECT_EQ(surface.triangles[1], (std::array<int, 3>{1, 3, 2}));
}

TEST(ReadSurface, WeldingHasNoTolerance) {
  std::string content = two_facets;
  content.replace(content.find("1 0 -0.0"), 8, "1 1e-300 0");
  EXPECT_EQ(read_text("a.stl", content).surface.points.size(), 5U);
}

TEST(ReadSurface, TakesBinaryStlThatBeginsWithSolid) {
  const TemporaryFolder folder;
  const auto path = folder / "a.stl";
  write_surface(path, annulus(1, 2, 8, 2));
  std::fstream(path, std::ios::in | std::ios::out | std::ios::binary) << "solid of CAD program";
  EXPECT_EQ(read_surface(path).surface.triangles.size(), 32U);
}

TEST(ReadSurface, ObjTakesRelativeIndicesAndSkipsTheRest) {
  const ReadResult result = read_text("a.obj",
                                      "# comment\nmtllib x.mtl\nv 0 0 0\nv 1 0 0 # here\r\n"
                                      "v 0 1 0\nvt 0 0\nvn 0 0 1\nf -3/1/1 -2//1 -1\nl 1 2\n");
  ASSERT_EQ(result.surface.triangles.size(), 1U);
  EXPECT_EQ(result.surface.triangles[0], (std::array<int, 3>{0, 1, 2}));
  EXPECT_TRUE(has_note(result, "1 line or point element was ignored"));
}

TEST(ReadSurface, OffTakesCommentsAndColours) {
  const ReadResult result = read_text(
      "a.off", "COFF # colours\n3 1 0\n0 0 0 1 1 1 1\n1 0 0 0 0 0 1\n\n0 1 0 0 0 0 1\n3 0 1 2 9\n");
  EXPECT_EQ(result.surface.points.size(), 3U);
  EXPECT_EQ(result.surface.triangles.size(), 1U);
}

TEST(ReadSurface, SplitsQuadsOnTheShorterDiagonal) {
  const std::string quad = "v 0 0 0\nv 2 0 0\nv 3 1 0\nv 0 1 0\nf 1 2 3 4\n";
  const ReadResult result = read_text("a.obj", quad);
  ASSERT_EQ(result.surface.triangles.size(), 2U);
  EXPECT_EQ(result.surface.triangles[0], (std::array<int, 3>{0, 1, 3}));
  EXPECT_EQ(result.surface.triangles[1], (std::array<int, 3>{1, 2, 3}));
  EXPECT_TRUE(has_note(result, "1 quad was"));
}

TEST(ReadSurface, SplitsConcavePolygons) {
  const std::string arrow = "v 0 0 0\nv 2 -2 0\nv 1 0 0\nv 2 2 0\nv -1 1 0\nf 1 2 3 4 5\n";
  const ReadResult result = read_text("a.obj", arrow);
  EXPECT_EQ(result.surface.triangles.size(), 3U);
  EXPECT_NEAR(total_area(result.surface), 4.0, 1e-12);  // shoelace formula
  EXPECT_TRUE(has_note(result, "1 polygon was"));
}

TEST(ReadSurface, RefusesPolygonsThatCannotBeSplit) {
  expect_read_error("a.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\nv 4 0 0\nf 1 2 3 4 5\n",
                    {"5 corners", "triangles"});
}

TEST(ReadSurface, ConvertsStripsAndIgnoresLines) {
  const ReadResult result =
      read_text("a.vtk", vtk_square_points + "LINES 1 3\n2 0 1\nTRIANGLE_STRIPS 1 5\n4 0 1 3 2\n");
  ASSERT_EQ(result.surface.triangles.size(), 2U);
  EXPECT_GT(doubled_area_vector(result.surface, 0).z(), 0.0);
  EXPECT_GT(doubled_area_vector(result.surface, 1).z(), 0.0);
  EXPECT_TRUE(has_note(result, "1 vertex or line cell was"));
}

TEST(ReadSurface, TakesTheTrianglesOfUnstructuredGrids) {
  const ReadResult result =
      read_text("a.vtk",
                "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\n"
                "POINTS 4 double\n0 0 0 1 0 0 0 1 0 0 0 1\n"
                "CELLS 3 14\n3 0 1 2\n4 0 1 2 3\n4 0 1 2 3\nCELL_TYPES 3\n5\n8\n10\n");
  EXPECT_EQ(result.surface.triangles.size(), 3U);  // a triangle, and a pixel of two
  EXPECT_TRUE(has_note(result, "1 volume or curved cell was"));
}

TEST(ReadSurface, LeavesOutUnusedPoints) {
  const ReadResult result = read_text("a.obj", "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 2 3 4\n");
  EXPECT_EQ(result.surface.points.size(), 3U);
  EXPECT_EQ(result.surface.points[0], Vec3(0, 0, 0));
  EXPECT_TRUE(has_note(result, "1 point that no triangle uses was"));
}

TEST(ReadSurface, ClosesSlitsButMergesNoInnerPoints) {
  TriangleSurface surface = annulus(1, 2, 8, 1);
  const int copies_begin = static_cast<int>(surface.points.size());
  surface.points.push_back(surface.points[0]);
  surface.points.push_back(surface.points[8]);
  for (auto& triangle : surface.triangles) {
    // The triangles at vertex 0 on the side of vertex 7 get the copies.
    if (triangle == std::array<int, 3>{7, 15, 0}) triangle[2] = copies_begin;
  }
  const TemporaryFolder folder;
  write_surface(folder / "a.off", surface);
  const ReadResult result = read_surface(folder / "a.off");
  EXPECT_EQ(result.surface.points.size(), 16U);
  EXPECT_TRUE(has_note(result, "closed a slit"));
}

// --- writing ------------------------------------------------------------------------------------

TEST(WriteSurface, RefusesUnknownExtensionsAndBadTargets) {
  const TemporaryFolder folder;
  const TriangleSurface surface = annulus(1, 2, 8, 1);
  const auto write = [&](const std::string& name) {
    return [&surface, path = folder / name] { write_surface(path, surface); };
  };
  expect_error(ExitCode::write, {"'.xyz'", ".stl"}, write("a.xyz"));
  expect_error(ExitCode::write, {"folder", "does not exist"}, write("nowhere/a.stl"));
  std::filesystem::create_directory(folder / "a.off");
  expect_error(ExitCode::write, {"directory"}, write("a.off"));
}

TEST(WriteSurface, ReportsAFullDevice) {
  // A link from the temporary name to a device without space stands for a full disk.
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full";
  const TemporaryFolder folder;
  const TriangleSurface surface = annulus(1, 2, 80, 20);
  for (const char* name : {"a.off", "a.obj", "a.stl", "a.ply", "a.vtp", "a.vtk"}) {
    const auto path = folder / name;
    std::filesystem::create_symlink("/dev/full", path.string() + ".part");
    expect_error(ExitCode::write, {name}, [&] { write_surface(path, surface); });
    EXPECT_FALSE(std::filesystem::exists(path)) << name;
  }
}

TEST(WriteSurface, LeavesNoTemporaryFileAndReplacesTheOld) {
  const TemporaryFolder folder;
  write_surface(folder / "a.off", annulus(1, 2, 8, 1));
  write_surface(folder / "a.off", annulus(1, 2, 8, 2));
  EXPECT_EQ(read_surface(folder / "a.off").surface.triangles.size(), 32U);
  const std::filesystem::directory_iterator files(folder.path());
  EXPECT_EQ(std::distance(begin(files), end(files)), 1);
}

// --- real surfaces ------------------------------------------------------------------------------

class SharedFiles : public testing::TestWithParam<test::Outcome> {};

TEST_P(SharedFiles, AreReadWithTheirPointsShared) {
  const auto folder = test::shared_data();
  if (!folder) GTEST_SKIP() << "no folder of shared data; set HEXWALL_SHARED_DATA";
  const TriangleSurface surface = read_surface(*folder / GetParam().surface).surface;
  EXPECT_EQ(static_cast<int>(surface.points.size()), GetParam().vertices);
  EXPECT_EQ(static_cast<int>(surface.triangles.size()), GetParam().triangles);
}

INSTANTIATE_TEST_SUITE_P(ReadSurface, SharedFiles, testing::ValuesIn(test::shared_files()));

}  // namespace
}  // namespace hexwall
