// CalculiX reads the Abaqus files and computes with them what theory says.

#include "support/calculix.h"

#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "exporters/abaqus.h"
#include "pipeline.h"
#include "support/block_mesh.h"
#include "support/lame.h"
#include "support/temporary_folder.h"
#include "surface/generate.h"

namespace hexwall::test {
namespace {

constexpr double kInnerRadius = 1.0;
constexpr double kOuterRadius = 1.2;
constexpr double kPressure = 2.0;
constexpr const char* kNotInstalled = "CalculiX (ccx) is not installed";

/// The wall of a cylinder of radius 1 and length 2.
HexMesh cylinder_wall(double size, int layers) {
  const double edge = 0.2 * size;
  const int around = static_cast<int>(std::lround(2.0 * std::numbers::pi / edge));
  const int along = static_cast<int>(std::lround(2.0 / (0.5 * std::numbers::sqrt3 * edge)));
  PipelineOptions options;
  options.size = size;
  options.outward->layers = layers;
  options.outward->thickness = kOuterRadius - kInnerRadius;
  return run_pipeline(cylinder(kInnerRadius, 2.0, around, along), options).wall;
}

/// The material of each zone, by name; all of them equal if there is one only.
std::string sections(const HexMesh& mesh, const std::vector<ElasticLayer>& materials) {
  std::string text;
  for (std::size_t m = 0; m < materials.size(); ++m)
    text += fmt::format("*MATERIAL, NAME=M{}\n*ELASTIC\n{}, {}\n", m, materials[m].young,
                        materials[m].poisson);
  for (std::size_t z = 0; z < mesh.zones.size(); ++z)
    text += fmt::format("*SOLID SECTION, ELSET={}, MATERIAL=M{}\n", mesh.zones[z].name,
                        z * materials.size() / mesh.zones.size());
  return text;
}

/// Plane strain: the end rings move radially only. That also leaves no rigid motion.
std::string pressurised_cylinder(const HexMesh& mesh, const std::vector<ElasticLayer>& materials) {
  std::string deck = "*INCLUDE, INPUT=wall.inp\n" + sections(mesh, materials);
  for (const char* loop : {"loop_0", "loop_1"})
    deck += fmt::format("*TRANSFORM, NSET={}, TYPE=C\n0, 0, 0, 0, 0, 1\n", loop);
  deck += fmt::format(
      "*STEP\n*STATIC\n*BOUNDARY\nloop_0, 2, 3\nloop_1, 2, 3\n"
      "*DSLOAD\ninner_wall, P, {}\n",
      kPressure);
  for (const char* wall : {"inner_wall", "outer_wall"})
    deck += fmt::format("*NODE PRINT, NSET={}, GLOBAL=YES\nU\n", wall);
  for (const CellGroup& zone : mesh.zones)
    deck += fmt::format("*EL PRINT, ELSET={0}\nCOORD\n*EL PRINT, ELSET={0}\nS\n", zone.name);
  return deck + "*END STEP\n";
}

double hoop_stress(const ElementMean& mean) {
  const double angle = std::atan2(mean.position.y(), mean.position.x());
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return mean.stress[0] * s * s + mean.stress[1] * c * c - 2 * mean.stress[3] * s * c;
}

/// Largest errors relative to the exact solution at the same radius.
struct Errors {
  double displacement = 0;  ///< radial, of the nodes on both walls
  double rotation = 0;      ///< tangential displacement there
  double hoop = 0;          ///< hoop stress, means of the elements
};

Errors errors_of(const HexMesh& mesh, const CalculixResult& result, const LameCylinder& exact) {
  Errors errors;
  for (const auto& [node, u] : result.displacement) {
    const Vec3& p = mesh.points.at(node - 1);
    const double r = std::hypot(p.x(), p.y());
    const double expected = exact.radial_displacement(r);
    const double radial = (u.x() * p.x() + u.y() * p.y()) / r;
    const double tangential = (u.y() * p.x() - u.x() * p.y()) / r;
    errors.displacement = std::max(errors.displacement, std::abs(radial / expected - 1));
    errors.rotation = std::max(errors.rotation, std::abs(tangential / expected));
  }
  for (const auto& [element, mean] : result.means) {
    const double expected = exact.hoop_stress(std::hypot(mean.position.x(), mean.position.y()));
    errors.hoop = std::max(errors.hoop, std::abs(hoop_stress(mean) / expected - 1));
  }
  return errors;
}

class CalculixCylinder : public testing::Test {
 protected:
  /// Fails unless every element and every node on both walls has a result.
  void solve(const HexMesh& mesh, const std::vector<ElasticLayer>& materials,
             const AbaqusOptions& options = {}) {
    write_abaqus(folder_ / "wall.inp", mesh, options);
    const CalculixResult result =
        run_calculix(folder_.path(), pressurised_cylinder(mesh, materials));
    available_ = result.available;
    if (!available_) return;
    ASSERT_TRUE(result.ok) << result.log;
    ASSERT_EQ(result.means.size(), mesh.shape.size());
    ASSERT_EQ(result.displacement.size(), 2 * mesh.points.size() / (mesh.zones.size() + 1));
    errors_ = errors_of(mesh, result, LameCylinder(kInnerRadius, materials, kPressure));
    RecordProperty("u_r", fmt::format("{:.5f}", errors_.displacement));
    RecordProperty("hoop", fmt::format("{:.5f}", errors_.hoop));
  }

  TemporaryFolder folder_;
  bool available_ = false;
  Errors errors_;
};

const std::vector<ElasticLayer> kOneMaterial{{kOuterRadius, 1000, 0.3}};

TEST_F(CalculixCylinder, IsWithinAPercentOfLame) {
  solve(cylinder_wall(0.2, 4), kOneMaterial);
  if (!available_) GTEST_SKIP() << kNotInstalled;
  EXPECT_LT(errors_.displacement, 5e-3);
  EXPECT_LT(errors_.hoop, 1e-2);
  EXPECT_LT(errors_.rotation, 1e-3);
}

TEST_F(CalculixCylinder, ConvergesToSecondOrder) {
  solve(cylinder_wall(0.4, 2), kOneMaterial);
  const Errors coarse = errors_;
  solve(cylinder_wall(0.2, 4), kOneMaterial);
  if (!available_) GTEST_SKIP() << kNotInstalled;
  EXPECT_GT(std::log2(coarse.displacement / errors_.displacement), 1.7);
  EXPECT_GT(std::log2(coarse.hoop / errors_.hoop), 1.7);
}

/// Intima, media and adventitia: a stiffer layer carries more than its share.
TEST_F(CalculixCylinder, OfThreeMaterialsFollowsLame) {
  solve(cylinder_wall(0.2, 6),
        {{1.0 + 0.2 / 3, 400, 0.3}, {1.0 + 0.4 / 3, 1500, 0.35}, {kOuterRadius, 700, 0.4}});
  if (!available_) GTEST_SKIP() << kNotInstalled;
  EXPECT_LT(errors_.displacement, 5e-3);
  EXPECT_LT(errors_.hoop, 1.2e-2);
}

TEST_F(CalculixCylinder, IsMoreExactWithIncompatibleModes) {
  const HexMesh mesh = cylinder_wall(0.2, 4);
  solve(mesh, kOneMaterial);
  const Errors plain = errors_;
  solve(mesh, kOneMaterial, {"C3D8I"});
  if (!available_) GTEST_SKIP() << kNotInstalled;
  EXPECT_LT(errors_.displacement, 0.5 * plain.displacement);
  EXPECT_LT(errors_.hoop, plain.hoop);
}

/// Integral of the outward normal.
Vec3 area_vector(const HexMesh& mesh, const CellPatch& patch) {
  Vec3 sum = Vec3::Zero();
  for (const CellFace& face : patch.faces) {
    const auto& v = face.vertices;
    const Vec3 diagonal_1 = mesh.points[v[2]] - mesh.points[v[0]];
    const Vec3 diagonal_2 = mesh.points[v[3]] - mesh.points[v[1]];
    sum += diagonal_1.cross(diagonal_2) / 2;
  }
  return sum;
}

/// A patch that has no vertex in common with `patch`.
const char* held_against(const std::string& patch) {
  if (patch == "inner_wall") return "outer_wall";
  if (patch == "outer_wall") return "inner_wall";
  return patch == "loop_0" ? "loop_1" : "loop_0";
}

/// The pressure on a patch is held by the nodes of another one: force = pressure · area, on all
/// patches of a vessel that is not symmetric. Only the right faces have the right resultant.
TEST(CalculixBifurcation, PressureOnEachPatchGivesPressureTimesArea) {
  const TemporaryFolder folder;
  PipelineOptions options;
  options.size = 0.4;
  options.outward->layers = 2;
  const HexMesh mesh = run_pipeline(generate_shape(Shape::bifurcation, 0.25), options).wall;
  write_abaqus(folder / "wall.inp", mesh);
  for (const CellPatch& patch : mesh.patches) {
    const std::string held = held_against(patch.name);
    const CalculixResult result = run_calculix(
        folder.path(),
        fmt::format("*INCLUDE, INPUT=wall.inp\n{}*STEP\n*STATIC\n*BOUNDARY\n{}, 1, 3\n*DSLOAD\n"
                    "{}, P, {}\n*NODE PRINT, NSET={}, TOTALS=ONLY\nRF\n*END STEP\n",
                    sections(mesh, kOneMaterial), held, patch.name, kPressure, held));
    if (!result.available) GTEST_SKIP() << kNotInstalled;
    ASSERT_TRUE(result.ok) << result.log;
    const Vec3 expected = kPressure * area_vector(mesh, patch);
    ASSERT_GT(expected.norm(), 0.1) << patch.name;
    EXPECT_LT((result.total_force - expected).norm(), 1e-5 * expected.norm())
        << patch.name << ": " << result.total_force.transpose();
  }
}

/// Two regions in one deck, each with a material of its own by its name: pressure in the core is
/// carried to the outer skin through the interface.
TEST(CalculixMesh, TakesMaterialsByRegion) {
  const TemporaryFolder folder;
  PipelineOptions options;
  options.size = 0.4;
  options.outward->layers = 2;
  options.inward = LayerOptions{};
  const HexMesh mesh = run_pipeline(cylinder(1.0, 2.0, 24, 12), options).wall;
  write_abaqus(folder / "wall.inp", mesh);
  const Vec3 expected = kPressure * area_vector(mesh, mesh.patches[2]);
  const CalculixResult result = run_calculix(
      folder.path(),
      fmt::format("*INCLUDE, INPUT=wall.inp\n*MATERIAL, NAME=A\n*ELASTIC\n1000, 0.3\n"
                  "*MATERIAL, NAME=B\n*ELASTIC\n10, 0.3\n*SOLID SECTION, ELSET=wall, MATERIAL=A\n"
                  "*SOLID SECTION, ELSET=lumen, MATERIAL=B\n*STEP\n*STATIC\n*BOUNDARY\n"
                  "outer_wall, 1, 3\n*DSLOAD\n{}, P, {}\n"
                  "*NODE PRINT, NSET=outer_wall, TOTALS=ONLY\nRF\n*END STEP\n",
                  mesh.patches[2].name, kPressure));
  if (!result.available) GTEST_SKIP() << kNotInstalled;
  ASSERT_TRUE(result.ok) << result.log;
  ASSERT_GT(expected.norm(), 0.01);
  EXPECT_LT((result.total_force - expected).norm(), 1e-4 * expected.norm());
}

/// The nodes of an .frd file: what CalculiX took the coordinates for.
std::map<int, Vec3> nodes_of_frd(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::map<int, Vec3> nodes;
  bool in_nodes = false;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("    2C")) in_nodes = true;
    if (line.starts_with(" -3")) in_nodes = false;
    if (!in_nodes || !line.starts_with(" -1")) continue;
    const auto column = [&](std::size_t i) { return std::stod(line.substr(13 + 12 * i, 12)); };
    nodes[std::stoi(line.substr(3, 10))] = {column(0), column(1), column(2)};
  }
  return nodes;
}

/// CalculiX reads 20 characters of a number. 17 digits and an exponent are more.
TEST(CalculixMesh, ReadsSmallCoordinates) {
  const TemporaryFolder folder;
  HexMesh mesh = block_mesh({7, 3, 2, 1, 1.5, 3});
  for (Vec3& p : mesh.points) p *= -1e-5 / 3;
  for (int hex = 0; hex < mesh.cells(); ++hex) {  // the sign has turned them inside out
    const auto first = mesh.connectivity.begin() + mesh.offset[hex];
    std::swap_ranges(first, first + 4, first + 4);
  }
  for (auto& patch : mesh.patches)
    for (auto& face : patch.faces) std::swap(face.vertices[1], face.vertices[3]);
  write_abaqus(folder / "wall.inp", mesh);
  const CalculixResult result = run_calculix(
      folder.path(), "*INCLUDE, INPUT=wall.inp\n" + sections(mesh, kOneMaterial) +
                         "*STEP\n*STATIC\n*BOUNDARY\nouter_wall, 1, 3\n*NODE FILE\nU\n*END STEP\n");
  if (!result.available) GTEST_SKIP() << kNotInstalled;
  ASSERT_TRUE(result.ok) << result.log;
  const auto nodes = nodes_of_frd(folder / "job.frd");
  ASSERT_EQ(nodes.size(), mesh.points.size());
  for (const auto& [node, p] : nodes)
    EXPECT_LT((p - mesh.points[node - 1]).norm(), 1e-5 * mesh.points[node - 1].norm());
}

}  // namespace
}  // namespace hexwall::test
