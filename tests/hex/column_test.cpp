// Columns of hexes: what is said of them against exact values and against OpenFOAM's checkMesh.

#include "hex/column.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "exporters/openfoam.h"
#include "hex/cell_geometry.h"
#include "hex/extrude.h"
#include "hex/mend_face_tets.h"
#include "hex/thickness.h"
#include "support/check_mesh.h"
#include "support/temporary_folder.h"

namespace hexwall::test {
namespace {

constexpr int cells = 8;

int vertex(int i, int j) {
  return i * (cells + 1) + j;
}

/// A square grid over [-1, 1]^2 at the height `z` of each vertex.
template <typename Height>
QuadMesh grid(const Height& z) {
  QuadMesh mesh;
  for (int i = 0; i <= cells; ++i) {
    for (int j = 0; j <= cells; ++j) {
      const double x = 2.0 * i / cells - 1.0;
      const double y = 2.0 * j / cells - 1.0;
      mesh.points.emplace_back(x, y, z(x, y));
      const bool is_inside = 0 < i && i < cells && 0 < j && j < cells;
      mesh.loop_of_vertex.push_back(is_inside ? -1 : 0);
    }
  }
  for (int i = 0; i < cells; ++i) {
    for (int j = 0; j < cells; ++j) {
      mesh.quads.push_back(
          {vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
    }
  }
  return mesh;
}

/// Heights at the vertices that are up and down in turn: quads warped by `warp`.
QuadMesh warped(double warp) {
  return grid([&](double x, double y) {
    const auto i = std::lround((x + y + 2.0) * cells / 2.0);
    return (i % 2 == 0 ? 0.25 : -0.25) * warp;
  });
}

WallShape upward(const QuadMesh& mesh, int layers, double thickness) {
  return {plan_layers(graded_layers(layers, 1.0, "layer_"), {}),
          std::vector<double>(mesh.points.size(), thickness),
          {}};
}

std::vector<Vec3> up(const QuadMesh& mesh) {
  return std::vector<Vec3>(mesh.points.size(), Vec3::UnitZ());
}

TEST(CellGeometry, OfASkewedBoxIsExact) {
  // A parallelepiped: the centre is the mean of the corners, faces have the area of the edges'
  // cross product.
  const Vec3 a(2.0, 0.0, 0.0);
  const Vec3 b(0.5, 1.0, 0.0);
  const Vec3 c(0.3, 0.2, 3.0);
  const Vec3 o(1.0, -2.0, 0.5);
  const Vec3 center =
      cell_center({o, o + a, o + a + b, o + b, o + c, o + a + c, o + a + b + c, o + b + c});
  EXPECT_NEAR((center - (o + 0.5 * (a + b + c))).norm(), 0.0, 1e-14);
  const FaceGeometry face = face_geometry(Face{o, o + a, o + a + b, o + b});
  EXPECT_NEAR((face.area - Vec3(0.0, 0.0, 2.0)).norm(), 0.0, 1e-14);
  EXPECT_NEAR((face.center - (o + 0.5 * (a + b))).norm(), 0.0, 1e-14);
}

TEST(CellGeometry, CenterOfAFrustumIsItsCentroid) {
  // Square frustum, sides 2 and 1, height 1: centroid at (4 + 2·2·1 + 3·1) / (4 (4 + 2 + 1)).
  std::array<Vec3, 8> corners;
  const std::array<std::array<double, 2>, 4> square{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
  for (int k = 0; k < 4; ++k) {
    corners[k] = Vec3(square[k][0], square[k][1], 0.0);
    corners[k + 4] = Vec3(0.5 * square[k][0], 0.5 * square[k][1], 1.0);
  }
  EXPECT_NEAR((cell_center(corners) - Vec3(0.0, 0.0, 11.0 / 28.0)).norm(), 0.0, 1e-14);
}

TEST(CornerDeficit, IsThatOfTheAnglesOnAFlatColumn) {
  // Corners of 60 and 120 degrees on both levels: 8 (1 - sin 60°)^16, or ^64.
  const double h = 0.5 * std::numbers::sqrt3;
  Column column;
  column.base = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1.5, h, 0), Vec3(0.5, h, 0)};
  column.direction.fill(Vec3::UnitZ());
  column.outward.fill(1.0);
  column.inward.fill(0.0);
  for (const int squarings : {4, 6}) {
    const double expected = 8.0 * std::pow(1.0 - h, std::pow(2.0, squarings));
    EXPECT_NEAR(corner_deficit(column, {0.0, 1.0}, squarings) / expected, 1.0, 1e-12);
  }
  EXPECT_NEAR(scaled_jacobian(column, {0.0, 1.0}), h, 1e-14);
}

// Its corners lean inward: a good hex at every thickness, until it closes up.
TEST(WidthAtSkins, IsWhatAFrustumLeavesOfItsBase) {
  Column column;
  column.base = {Vec3(-1, -2, 0), Vec3(1, -2, 0), Vec3(1, 2, 0), Vec3(-1, 2, 0)};
  for (int k = 0; k < 4; ++k) {
    column.direction[k] = Vec3(-column.base[k].x(), -column.base[k].y(), 4.0).normalized();
  }
  const double to_apex = Vec3(1, 2, 4).norm();
  column.outward.fill(0.9 * to_apex);
  column.inward.fill(0.5 * to_apex);
  EXPECT_NEAR(width_at_skins(column, {0.0, 0.5, 1.0}), 0.1, 1e-14);
  EXPECT_NEAR(width_at_skins(column, {-1.0, 0.0}), 1.0, 1e-14) << "wider inside";
  EXPECT_NEAR(width_at_skins(column, {-1.0, 0.0, 1.0}), 0.1, 1e-14);
  column.outward.fill(1.2 * to_apex);
  EXPECT_NEAR(width_at_skins(column, {0.0, 1.0}), -0.2, 1e-14) << "turned over";
  EXPECT_GT(flat_quality(column), 0.4) << "which the base does not tell";
}

/// Layers on quads that are warped by a multiple of the height of a layer.
class WarpedQuads : public testing::TestWithParam<double> {};

TEST_P(WarpedQuads, HaveFaceTetsIfOpenFoamFindsThem) {
  const int layers = 3;
  const double thickness = 0.15;
  const QuadMesh mesh = warped(GetParam() * thickness / layers);
  const WallShape shape = upward(mesh, layers, thickness);
  const HexMesh hexes = extrude(mesh, up(mesh), {"rim"}, shape);
  const TemporaryFolder folder;
  write_openfoam(folder.path(), hexes, 1.0);
  const CheckMeshResult checked = check_mesh(folder.path());
  if (!checked.available) GTEST_SKIP() << "checkMesh is not installed";
  bool all = true;
  for (int q = 0; q < static_cast<int>(mesh.quads.size()); ++q) {
    all = all && has_face_tets(column_of(mesh, q, up(mesh), shape), shape.plan.levels);
  }
  EXPECT_EQ(all, checked.log.find("Error in face tets") == std::string::npos) << checked.log;
  EXPECT_EQ(all, GetParam() < 1.5);
}

INSTANTIATE_TEST_SUITE_P(, WarpedQuads, testing::Values(0.0, 0.5, 0.9, 3.0, 6.0),
                         [](const auto& test) {
                           return "by_" + std::to_string(std::lround(10 * test.param)) +
                                  "_tenths_of_a_layer";
                         });

TEST(FaceTetMargin, OfABrickIsHalf) {
  const QuadMesh mesh = grid([](double, double) { return 0.0; });
  for (const double thickness : {0.03, 0.3}) {
    const WallShape shape = upward(mesh, 3, thickness);
    const Column column = column_of(mesh, 0, up(mesh), shape);
    EXPECT_NEAR(face_tet_margin(column, shape.plan.levels), 0.5, 1e-12);
  }
}

int columns_without_face_tets(const QuadMesh& mesh, const std::vector<Vec3>& directions,
                              const WallShape& shape) {
  int count = 0;
  for (int q = 0; q < static_cast<int>(mesh.quads.size()); ++q) {
    if (!has_face_tets(column_of(mesh, q, directions, shape), shape.plan.levels)) ++count;
  }
  return count;
}

/// One direction is so far from the others that the faces between layers are warped around it.
TEST(MendFaceTets, TurnsBackWhatWarpsThem) {
  QuadMesh mesh = grid([](double, double) { return 0.0; });
  TriangleSurface surface{mesh.points, {}};
  std::vector<SurfacePoint> places(mesh.points.size());
  for (const auto& [a, b, c, d] : mesh.quads) {
    const auto first = static_cast<int>(surface.triangles.size());
    for (const int v : {a, b, c}) places[v] = {first, mesh.points[v]};
    places[d] = {first + 1, mesh.points[d]};
    surface.triangles.push_back({a, b, c});
    surface.triangles.push_back({a, c, d});
  }
  const Connectivity connectivity = connectivity_of(surface);
  const SurfaceProjector projector(surface, connectivity);
  const WallShape shape = upward(mesh, 8, 0.2);
  std::vector<Vec3> directions = up(mesh);
  const int tilted = vertex(3, 4);
  directions[tilted] = Vec3(std::sin(1.1), 0.0, std::cos(1.1));
  ASSERT_GE(columns_without_face_tets(mesh, directions, shape), 1);
  const QuadMesh before = mesh;
  const int moved = mend_face_tets(mesh, places, directions, projector, shape);
  EXPECT_EQ(columns_without_face_tets(mesh, directions, shape), 0);
  EXPECT_GE(moved, 1);
  EXPECT_LE(moved, 9);
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const double distance = (before.points[v] - before.points[tilted]).norm();
    if (distance > 0.4) {
      EXPECT_EQ(mesh.points[v], before.points[v]);
      EXPECT_EQ(directions[v], Vec3(Vec3::UnitZ()));
    }
  }
}

TEST(FitThickness, EndsOnMeshesWithVeryShortEdges) {
  // A bowl, too narrow for the wall inside it, with two rows of vertices that nearly coincide.
  QuadMesh mesh = grid([](double x, double y) { return 2.0 * (x * x + y * y); });
  for (int j = 0; j <= cells; ++j) {
    Vec3& p = mesh.points[vertex(3, j)];
    p = mesh.points[vertex(4, j)] + 1e-9 * (p - mesh.points[vertex(4, j)]);
  }
  std::vector<Vec3> normals;
  for (const Vec3& p : mesh.points) {
    normals.push_back(Vec3(-4.0 * p.x(), -4.0 * p.y(), 1.0).normalized());
  }
  const ThicknessResult result = fit_thickness(mesh, normals, upward(mesh, 2, 0.5), Side::outward);
  EXPECT_GT(result.reduced_area_fraction, 0.1);
  EXPECT_GT(result.given[vertex(3, 4)], 0.0);
}

}  // namespace
}  // namespace hexwall::test
