#include "exporters/openfoam.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/errors.h"
#include "hex/cell_faces.h"
#include "support/block_mesh.h"
#include "support/check_mesh.h"
#include "support/temporary_folder.h"

namespace hexwall {
namespace {

using testing::HasSubstr;

const std::vector<std::string> kFiles{
    "constant/polyMesh/points",    "constant/polyMesh/faces",    "constant/polyMesh/owner",
    "constant/polyMesh/neighbour", "constant/polyMesh/boundary", "constant/polyMesh/cellZones",
    "system/controlDict",          "system/fvSchemes",           "system/fvSolution"};

struct Patch {
  std::string name;
  std::string type;
  int faces;
  int start;
};

/// A polyMesh folder as read back by this test's own small parser.
struct PolyMesh {
  std::vector<Vec3> points;
  std::vector<std::array<int, 4>> faces;
  std::vector<int> owner;
  std::vector<int> neighbour;
  std::vector<Patch> patches;
};

/// The file's tokens after its header; parentheses and semicolons count as blanks.
std::istringstream body_of(const std::filesystem::path& file) {
  std::string text = bytes_of(file);
  text.erase(0, text.find('}') + 1);
  for (char& c : text)
    if (c == '(' || c == ')' || c == ';') c = ' ';
  return std::istringstream(text);
}

template <typename T>
T next(std::istream& in) {
  T value{};
  EXPECT_TRUE(in >> value);
  return value;
}

std::vector<int> read_labels(const std::filesystem::path& file) {
  auto in = body_of(file);
  std::vector<int> labels(next<int>(in));
  for (int& label : labels) label = next<int>(in);
  return labels;
}

std::vector<Patch> read_boundary(const std::filesystem::path& file) {
  auto in = body_of(file);
  std::vector<Patch> patches(next<int>(in));
  std::string word;
  for (Patch& p : patches)
    in >> p.name >> word >> word >> p.type >> word >> p.faces >> word >> p.start >> word;
  return patches;
}

PolyMesh read_poly_mesh(const std::filesystem::path& folder) {
  PolyMesh mesh;
  auto points = body_of(folder / "points");
  mesh.points.resize(next<int>(points));
  for (Vec3& p : mesh.points) points >> p.x() >> p.y() >> p.z();
  auto faces = body_of(folder / "faces");
  mesh.faces.resize(next<int>(faces));
  for (auto& face : mesh.faces) {
    EXPECT_EQ(next<int>(faces), 4);
    for (int& v : face) v = next<int>(faces);
  }
  mesh.owner = read_labels(folder / "owner");
  mesh.neighbour = read_labels(folder / "neighbour");
  mesh.patches = read_boundary(folder / "boundary");
  return mesh;
}

Vec3 area_vector(const PolyMesh& mesh, std::size_t f) {
  const auto& v = mesh.faces[f];
  const Vec3 diagonal_1 = mesh.points[v[2]] - mesh.points[v[0]];
  const Vec3 diagonal_2 = mesh.points[v[3]] - mesh.points[v[1]];
  return diagonal_1.cross(diagonal_2) / 2;
}

/// Calls `visit(cell, face, sign)` for both sides of each face; sign 1 if the face points out.
template <typename Visit>
void for_each_side(const PolyMesh& mesh, Visit visit) {
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    visit(mesh.owner[f], f, 1.0);
    if (f < mesh.neighbour.size()) visit(mesh.neighbour[f], f, -1.0);
  }
}

/// Volume of each cell by the divergence theorem; exact for planar faces.
std::vector<double> cell_volumes(const PolyMesh& mesh, std::size_t cells) {
  std::vector<double> volumes(cells, 0);
  for_each_side(mesh, [&](int cell, std::size_t f, double sign) {
    volumes[cell] += sign * mesh.points[mesh.faces[f][0]].dot(area_vector(mesh, f)) / 3;
  });
  return volumes;
}

double sum(const std::vector<double>& values) {
  double total = 0;
  for (const double v : values) total += v;
  return total;
}

class OpenFoam : public testing::TestWithParam<BlockTube> {};

TEST_P(OpenFoam, FacesAreInUpperTriangularOrder) {
  const TemporaryFolder folder;
  write_openfoam(folder.path(), block_mesh(GetParam()), 1);
  const PolyMesh mesh = read_poly_mesh(folder / "constant/polyMesh");
  ASSERT_EQ(mesh.owner.size(), mesh.faces.size());
  ASSERT_FALSE(mesh.neighbour.empty());
  for (std::size_t f = 0; f < mesh.neighbour.size(); ++f) {
    EXPECT_LT(mesh.owner[f], mesh.neighbour[f]);
    if (f == 0) continue;
    EXPECT_LT(std::pair(mesh.owner[f - 1], mesh.neighbour[f - 1]),
              std::pair(mesh.owner[f], mesh.neighbour[f]));
  }
}

TEST_P(OpenFoam, CellsAreClosedAndFillTheTube) {
  const TemporaryFolder folder;
  const HexMesh hexes = block_mesh(GetParam());
  write_openfoam(folder.path(), hexes, 1);
  const PolyMesh mesh = read_poly_mesh(folder / "constant/polyMesh");
  std::vector<Vec3> sums(hexes.shape.size(), Vec3::Zero());
  for_each_side(mesh, [&](int cell, std::size_t f, double sign) {
    sums[cell] += sign * area_vector(mesh, f);
  });
  for (const Vec3& s : sums) EXPECT_LT(s.norm(), 1e-14);
  const auto volumes = cell_volumes(mesh, hexes.shape.size());
  EXPECT_GT(*std::min_element(volumes.begin(), volumes.end()), 0);
  EXPECT_NEAR(sum(volumes), volume(GetParam()), 1e-12 * volume(GetParam()));
}

TEST_P(OpenFoam, PatchesAreContiguousInOrder) {
  const TemporaryFolder folder;
  const HexMesh hexes = block_mesh(GetParam());
  write_openfoam(folder.path(), hexes, 1);
  const PolyMesh mesh = read_poly_mesh(folder / "constant/polyMesh");
  ASSERT_EQ(mesh.patches.size(), hexes.patches.size());
  int start = static_cast<int>(mesh.neighbour.size());
  for (std::size_t p = 0; p < mesh.patches.size(); ++p) {
    EXPECT_EQ(mesh.patches[p].name, hexes.patches[p].name);
    EXPECT_EQ(mesh.patches[p].type, hexes.patches[p].is_wall ? "wall" : "patch");
    EXPECT_EQ(mesh.patches[p].faces, static_cast<int>(hexes.patches[p].faces.size()));
    EXPECT_EQ(mesh.patches[p].start, start);
    start += mesh.patches[p].faces;
  }
  EXPECT_EQ(start, static_cast<int>(mesh.faces.size()));
}

TEST_P(OpenFoam, PassesCheckMesh) {
  const TemporaryFolder folder;
  write_openfoam(folder.path(), block_mesh(GetParam()), 1e-3);
  const CheckMeshResult result = check_mesh(folder.path());
  if (!result.available) GTEST_SKIP() << "checkMesh is not on PATH";
  EXPECT_TRUE(result.ok) << result.log;
  EXPECT_THAT(result.log, HasSubstr("Upper triangular ordering OK."));
}

INSTANTIATE_TEST_SUITE_P(Tubes, OpenFoam,
                         testing::Values(BlockTube{}, BlockTube{6, 2, 2},
                                         BlockTube{24, 12, 4, 1, 1.2, 5},
                                         BlockTube{24, 12, 5, 1, 1.5, 5, 2}));

// The interface is the faces whose owner is in the lumen and whose neighbour is in the wall.
TEST(OpenFoamFiles, TwoRegionsHaveAnInterfaceAndSets) {
  const TemporaryFolder folder;
  const HexMesh hexes = block_mesh({12, 4, 5, 1, 1.5, 3, 2});
  write_openfoam(folder.path(), hexes, 1);
  const auto poly_mesh = folder / "constant/polyMesh";
  const PolyMesh mesh = read_poly_mesh(poly_mesh);
  std::vector<bool> in_lumen(hexes.shape.size(), false);
  for (const int cell : read_labels(poly_mesh / "sets/lumen")) in_lumen.at(cell) = true;
  EXPECT_EQ(std::count(in_lumen.begin(), in_lumen.end(), true), 12 * 4 * 2);
  const std::vector<int> wall = read_labels(poly_mesh / "sets/wall");
  EXPECT_EQ(wall.size(), 12U * 4U * 3U);
  for (const int cell : wall) EXPECT_FALSE(in_lumen.at(cell));

  auto in = body_of(poly_mesh / "faceZones");
  std::string word;
  EXPECT_EQ(next<int>(in), 1);
  EXPECT_EQ(next<std::string>(in), "interface");
  while (in >> word && word != "List<label>") continue;
  std::vector<int> faces(next<int>(in));
  EXPECT_EQ(faces.size(), 12U * 4U);
  for (int& face : faces) {
    face = next<int>(in);
    EXPECT_TRUE(in_lumen.at(mesh.owner.at(face)));
    EXPECT_FALSE(in_lumen.at(mesh.neighbour.at(face)));
  }
  while (in >> word && word != "List<bool>") continue;
  EXPECT_EQ(next<int>(in), 12 * 4);
  for (std::size_t i = 0; i < faces.size(); ++i) EXPECT_EQ(next<int>(in), 0);
  std::sort(faces.begin(), faces.end());
  EXPECT_EQ(std::unique(faces.begin(), faces.end()), faces.end());
}

TEST(OpenFoamFiles, PointsAreInMetresToTheLastBit) {
  const TemporaryFolder folder;
  const HexMesh hexes = block_mesh({});
  write_openfoam(folder.path(), hexes, 1e-3);
  const PolyMesh mesh = read_poly_mesh(folder / "constant/polyMesh");
  ASSERT_EQ(mesh.points.size(), hexes.points.size());
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    for (int d = 0; d < 3; ++d) EXPECT_EQ(mesh.points[i][d], 1e-3 * hexes.points[i][d]);
}

TEST(OpenFoamFiles, OwnerNotesTheSizes) {
  const TemporaryFolder folder;
  write_openfoam(folder.path(), block_mesh({3, 1, 1}), 1);
  EXPECT_THAT(bytes_of(folder / "constant/polyMesh/owner"),
              HasSubstr("\"nPoints:12  nCells:3  nFaces:15  nInternalFaces:3\""));
}

TEST(OpenFoamFiles, EqualRunsWriteEqualBytes) {
  const TemporaryFolder folder;
  write_openfoam(folder / "a", block_mesh({}), 1e-3);
  write_openfoam(folder / "b", block_mesh({}), 1e-3);
  for (const std::string& file : kFiles) {
    EXPECT_FALSE(bytes_of(folder / "a" / file).empty()) << file;
    EXPECT_EQ(bytes_of(folder / "a" / file), bytes_of(folder / "b" / file)) << file;
  }
}

// checkMesh builds the determinant of a cell from its internal faces alone, so it calls the nearly
// flat cells of a single layer under-determined. No other complaint is allowed.
TEST(OpenFoamFiles, ASingleLayerOnlyFailsTheDeterminantCheck) {
  const TemporaryFolder folder;
  write_openfoam(folder.path(), block_mesh({200, 40, 1}), 1);
  const CheckMeshResult result = check_mesh(folder.path());
  if (!result.available) GTEST_SKIP() << "checkMesh is not on PATH";
  EXPECT_FALSE(result.ok);
  EXPECT_THAT(result.log, HasSubstr("Cells with small determinant"));
  EXPECT_THAT(result.log, HasSubstr("Failed 1 mesh checks."));
}

TEST(OpenFoamFiles, AnEmptyPatchIsWritten) {
  const TemporaryFolder folder;
  HexMesh mesh = block_mesh({});
  mesh.patches.push_back({"nothing", false, {}});
  write_openfoam(folder.path(), mesh, 1);
  const CheckMeshResult result = check_mesh(folder.path());
  if (!result.available) GTEST_SKIP() << "checkMesh is not on PATH";
  EXPECT_TRUE(result.ok) << result.log;
}

TEST(OpenFoamFiles, CheckMeshRefusesAnInvertedHex) {
  const TemporaryFolder folder;
  HexMesh mesh = block_mesh({});
  const auto hex = mesh.corners(0);
  std::swap(mesh.points[hex[0]], mesh.points[hex[4]]);
  write_openfoam(folder.path(), mesh, 1);
  const CheckMeshResult result = check_mesh(folder.path());
  if (!result.available) GTEST_SKIP() << "checkMesh is not on PATH";
  EXPECT_FALSE(result.ok);
  EXPECT_THAT(result.log, HasSubstr("Failed"));
}

TEST(OpenFoamFiles, AFileInPlaceOfAFolderIsAWriteError) {
  const TemporaryFolder folder;
  std::ofstream(folder / "file") << "x";
  try {
    write_openfoam(folder / "file/case", block_mesh({}), 1);
    FAIL() << "nothing was thrown";
  } catch (const WriteError& e) {
    EXPECT_THAT(e.what(), HasSubstr((folder / "file/case").string()));
    EXPECT_THAT(e.what(), HasSubstr("Not a directory"));
  }
}

TEST(OpenFoamFiles, AFailedRunLeavesNoMesh) {
  const TemporaryFolder folder;
  // A folder of that name cannot be replaced by a file.
  std::filesystem::create_directories(folder / "constant/polyMesh/boundary/x");
  EXPECT_THROW(write_openfoam(folder.path(), block_mesh({}), 1), WriteError);
  const std::filesystem::directory_iterator left(folder / "constant/polyMesh");
  EXPECT_EQ(std::distance(begin(left), end(left)), 1);
}

/// Spoils a mesh in one way, and a part of the message that tells of it.
struct Spoiled {
  std::string name;
  void (*spoil)(CellMesh&);
  std::string message;
};

class InconsistentMesh : public testing::TestWithParam<Spoiled> {};

TEST_P(InconsistentMesh, IsAnInternalErrorAndNothingIsWritten) {
  const TemporaryFolder folder;
  CellMesh mesh = block_mesh({});
  GetParam().spoil(mesh);
  try {
    write_openfoam(folder / "case", mesh, 1);
    FAIL() << "nothing was thrown";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::internal);
    EXPECT_THAT(e.what(), HasSubstr(GetParam().message));
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "case"));
}

/// Hexes in one zone, and no patches.
CellMesh mesh_of_hexes(const std::vector<Vec3>& points,
                       const std::vector<std::span<const int>>& hexes) {
  CellMesh mesh;
  mesh.points = points;
  mesh.zones = {{"z", {}}};
  for (const auto& hex : hexes) {
    mesh.zones[0].cells.push_back(mesh.cells());
    mesh.add(CellShape::hexahedron, hex);
  }
  return mesh;
}

const std::vector<Spoiled> kSpoiled{
    {"ThreeHexesAtAFace",
     [](CellMesh& m) {
       // The first hex again, but with the last one's vertices where its neighbour has none.
       const auto first = m.corners(0), second = m.corners(1), last = m.corners(m.cells() - 1);
       std::vector<int> third(first.begin(), first.end());
       for (int k = 0; k < 8; ++k) {
         if (std::find(second.begin(), second.end(), first[k]) == second.end()) third[k] = last[k];
       }
       m = mesh_of_hexes(m.points, {first, second, third});
     },
     "third cell"},
    {"TwoHexesOnOneSide",
     [](CellMesh& m) {
       m = mesh_of_hexes(m.points, {m.corners(0), m.corners(0)});
     },
     "same side"},
    {"NoSuchVertex", [](CellMesh& m) { m.connectivity[8 * 3 + 5] = 100000; }, "vertex 100000"},
    {"FaceInNoPatch", [](CellMesh& m) { m.patches[0].faces.pop_back(); }, "in no patch"},
    {"FaceInTwoPatches", [](CellMesh& m) { m.patches[1].faces.push_back(m.patches[0].faces[0]); },
     "listed twice"},
    {"InternalFaceInAPatch",
     [](CellMesh& m) {
       m.patches[0].faces.push_back({cell_face(m, 0, 5), 0});
     },
     "not on the boundary"},
    {"FaceOfAnotherHex", [](CellMesh& m) { m.patches[0].faces[0].cell = 30; }, "does not have"},
    {"FaceOfNoHex", [](CellMesh& m) { m.patches[0].faces[0].cell = -1; }, "names cell -1"},
    {"FaceSeenFromInside",
     [](CellMesh& m) {
       auto& v = m.patches[0].faces[0].vertices;
       std::swap(v[0], v[2]);
     },
     "orientation"},
    {"HexInNoZone", [](CellMesh& m) { m.zones[1].cells.pop_back(); }, "in no zone"},
    {"HexInTwoZones", [](CellMesh& m) { m.zones[1].cells.push_back(0); }, "already"},
    {"PatchNameWithABlank", [](CellMesh& m) { m.patches[2].name = "a b"; }, "'a b'"},
};

INSTANTIATE_TEST_SUITE_P(Spoiled, InconsistentMesh, testing::ValuesIn(kSpoiled),
                         [](const auto& tested) { return tested.param.name; });

TEST(OpenFoamFiles, TheUnitOfLengthMustBePositive) {
  const TemporaryFolder folder;
  EXPECT_THROW(write_openfoam(folder.path(), block_mesh({}), 0), Error);
}

}  // namespace
}  // namespace hexwall
