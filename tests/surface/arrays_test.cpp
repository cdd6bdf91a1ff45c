#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "support/expect_error.h"
#include "support/shared_data.h"
#include "support/temporary_folder.h"
#include "surface/polygon_soup.h"
#include "surface/read.h"

// Arrays of the input stay with their points and triangles. Most arrays below hold a function of
// the position, so that a value in the wrong place shows.
namespace hexwall {
namespace {

ReadResult read_text(const std::string& name, const std::string& content) {
  const TemporaryFolder folder;
  std::ofstream(folder / name, std::ios::binary) << content;
  return read_surface(folder / name);
}

const SurfaceArray& array_named(const std::vector<SurfaceArray>& arrays, const std::string& name) {
  const auto it = std::find_if(arrays.begin(), arrays.end(),
                               [&](const SurfaceArray& array) { return array.name == name; });
  if (it == arrays.end()) throw std::runtime_error("there is no array " + name);
  return *it;
}

/// The array holds 10 x + y of each point.
void expect_follows_points(const SurfaceArray& array, const TriangleSurface& surface) {
  ASSERT_EQ(array.values.size(), surface.points.size());
  for (std::size_t v = 0; v < surface.points.size(); ++v) {
    EXPECT_EQ(array.values[v], 10 * surface.points[v].x() + surface.points[v].y());
  }
}

/// The array holds the whole part of x of each triangle.
void expect_follows_triangles(const SurfaceArray& array, const TriangleSurface& surface) {
  ASSERT_EQ(array.values.size(), surface.triangles.size());
  for (int f = 0; f < static_cast<int>(surface.triangles.size()); ++f) {
    EXPECT_EQ(array.values[f], std::floor(centroid(surface, f).x()));
  }
}

// A row of: a line, a triangle, a quad, a pentagon and a strip of two, each one unit wide, and a
// point that none uses.
const std::string row_of_cells =
    "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\nPOINTS 11 double\n"
    "9 9 0\n0 0 0 1 0 0 1 1 0\n2 0 0 2 1 0\n3 0 0 3 1 0 2.5 2 0\n4 0 0 4 1 0\n"
    "LINES 1 3\n2 1 2\n"
    "POLYGONS 3 15\n3 1 2 3\n4 2 4 5 3\n5 4 6 7 8 5\n"
    "TRIANGLE_STRIPS 1 5\n4 6 9 7 10\n"
    "CELL_DATA 5\nSCALARS cell double 1\nLOOKUP_TABLE default\n7 0 1 2 3\n"
    "SCALARS other int 1\nLOOKUP_TABLE default\n0 1 2 3 4\n"
    "POINT_DATA 11\nSCALARS place double 1\nLOOKUP_TABLE default\n"
    "99 0 10 11 20 21 30 31 27 40 41\n"
    "VECTORS position double\n9 9 0\n0 0 0 1 0 0 1 1 0\n2 0 0 2 1 0\n3 0 0 3 1 0 2.5 2 0\n"
    "4 0 0 4 1 0\n";

TEST(Arrays, FollowPolygonsStripsAndDroppedPoints) {
  const ReadResult result = read_text("a.vtk", row_of_cells);
  ASSERT_EQ(result.surface.triangles.size(), 1U + 2U + 3U + 2U);
  ASSERT_EQ(result.surface.points.size(), 10U);
  expect_follows_triangles(array_named(result.cell_arrays, "cell"), result.surface);
  expect_follows_points(array_named(result.point_arrays, "place"), result.surface);
  const SurfaceArray& position = array_named(result.point_arrays, "position");
  EXPECT_EQ(position.components, 3);
  ASSERT_EQ(position.tuples(), 10);
  for (int v = 0; v < 10; ++v) {
    for (int k = 0; k < 3; ++k) {
      EXPECT_EQ(position.values[3 * v + k], result.surface.points[v][k]);
    }
  }
}

TEST(Arrays, AllOfALegacyFileAreRead) {
  const ReadResult result = read_text("a.vtk", row_of_cells);
  EXPECT_EQ(result.cell_arrays.size(), 2U);
  EXPECT_EQ(array_named(result.cell_arrays, "other").values,
            (std::vector<double>{1, 2, 2, 3, 3, 3, 4, 4}));
}

TEST(Arrays, OfVtpKeepTheirTypesValues) {
  const ReadResult result = read_text(
      "a.vtp",
      "<VTKFile type=\"PolyData\" version=\"1.0\"><PolyData>"
      "<Piece NumberOfPoints=\"4\" NumberOfPolys=\"1\">"
      "<PointData><DataArray type=\"Float64\" Name=\"place\" format=\"ascii\">0 10 11 1</DataArray>"
      "<Array type=\"String\" Name=\"words\" format=\"ascii\">65 0 66 0 67 0 68 "
      "0</Array></PointData>"
      "<CellData><DataArray type=\"Int32\" Name=\"ModelFaceID\" format=\"ascii\">-7</DataArray>"
      "</CellData>"
      "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">"
      "0 0 0 1 0 0 1 1 0 0 1 0</DataArray></Points>"
      "<Polys><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">0 1 2 3</DataArray>"
      "<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">4</DataArray></Polys>"
      "</Piece></PolyData></VTKFile>\n");
  expect_follows_points(array_named(result.point_arrays, "place"), result.surface);
  EXPECT_EQ(result.point_arrays.size(), 1U);  // words are no numbers
  EXPECT_EQ(array_named(result.cell_arrays, "ModelFaceID").values, (std::vector<double>{-7, -7}));
}

TEST(Arrays, OfTheWrongLengthAreIgnoredWithANote) {
  std::string content = row_of_cells;
  content += "FIELD more 1\nshort 1 3 double\n1 2 3\n";
  const ReadResult result = read_text("a.vtk", content);
  EXPECT_EQ(result.point_arrays.size(), 2U);
  EXPECT_TRUE(std::any_of(result.notes.begin(), result.notes.end(), [](const std::string& note) {
    return note.find("'short'") != std::string::npos && note.find("3 tuples") != std::string::npos;
  }));
}

TEST(Arrays, OfPlyAreItsScalarProperties) {
  const ReadResult result = read_text(
      "a.ply",
      "ply\nformat ascii 1.0\nelement vertex 6\nproperty float place\nproperty float x\n"
      "property float y\nproperty float z\nproperty float nx\nelement face 2\nproperty int first\n"
      "property list uchar int vertex_indices\nproperty float column\nelement edge 1\n"
      "property int weight\nend_header\n"
      "0 0 0 0 5\n10 1 0 0 5\n11 1 1 0 5\n1 0 1 0 5\n20 2 0 0 5\n21 2 1 0 5\n"
      "8 4 0 1 2 3 0\n9 4 1 4 5 2 1\n3\n");
  ASSERT_EQ(result.point_arrays.size(), 1U);
  expect_follows_points(array_named(result.point_arrays, "place"), result.surface);
  ASSERT_EQ(result.cell_arrays.size(), 2U);
  expect_follows_triangles(array_named(result.cell_arrays, "column"), result.surface);
  EXPECT_EQ(array_named(result.cell_arrays, "first").values, (std::vector<double>{8, 8, 9, 9}));
}

TEST(Arrays, PlyElementsAnnouncedTwiceAreRefused) {
  test::expect_error(ExitCode::read, {"'vertex'", "twice"}, [] {
    read_text("a.ply",
              "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
              "property float z\nelement vertex 1\nproperty float w\nelement face 0\n"
              "property list uchar int vertex_indices\nend_header\n0 0 0\n1\n");
  });
}

TEST(Arrays, OfMergedPointsAreThoseOfTheFirst) {
  PolygonSoup soup;
  soup.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  soup.polygons = {{0, 1, 2}, {3, 4, 5}};
  soup.point_arrays = {{"number", 1, {0, 1, 2, 3, 4, 5}}};
  weld_equal_points(soup);
  EXPECT_EQ(soup.point_arrays[0].values, (std::vector<double>{0, 1, 2, 4}));
}

TEST(Arrays, FollowAClosedSlit) {
  const ReadResult result = read_text("a.vtk",
                                      "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\n"
                                      "POINTS 6 double\n0 0 0 1 0 0 0 1 0 1 0 0 0 1 0 1 1 0\n"
                                      "POLYGONS 2 8\n3 0 1 2\n3 3 5 4\n"
                                      "POINT_DATA 6\nSCALARS place double 1\nLOOKUP_TABLE default\n"
                                      "0 10 1 10 1 11\n");
  ASSERT_EQ(result.surface.points.size(), 4U);
  expect_follows_points(result.point_arrays[0], result.surface);
}

TEST(Arrays, HaveNoNumberForWhatIsNew) {
  const SurfaceArray array{"pair", 2, {0, 1, 10, 11, 20, 21}};
  const SurfaceArray followed = follow(array, {2, -1, 0});
  ASSERT_EQ(followed.tuples(), 3);
  EXPECT_EQ(followed.values[0], 20);
  EXPECT_EQ(followed.values[1], 21);
  EXPECT_TRUE(std::isnan(followed.values[2]) && std::isnan(followed.values[3]));
  EXPECT_EQ(followed.values[4], 0);
}

TEST(Arrays, OfRealFilesFitTheirSurface) {
  const auto folder = test::shared_data();
  if (!folder) GTEST_SKIP() << "no folder of shared data; set HEXWALL_SHARED_DATA";
  std::set<std::string> names;
  for (const test::SharedFile& file : test::shared_files) {
    const ReadResult result = read_surface(*folder / file.name);
    for (const SurfaceArray& array : result.point_arrays) {
      EXPECT_EQ(array.tuples(), file.vertices) << file.name << " " << array.name;
      names.insert(array.name);
    }
    for (const SurfaceArray& array : result.cell_arrays) {
      EXPECT_EQ(array.tuples(), file.triangles) << file.name << " " << array.name;
      names.insert(array.name);
    }
  }
  EXPECT_TRUE(names.contains("CellEntityIds"));  // of vampy_case71_remeshed.vtp
}

}  // namespace
}  // namespace hexwall
