// Measures of single elements against values computed by hand.

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>

#include "inspect/small_meshes.h"

namespace hexwall::test {
namespace {

constexpr double eps = 1e-12;

MeshQuality quality_of(ElementShape shape, const std::vector<Vec3>& points) {
  return mesh_quality(single(shape, points));
}

std::vector<Vec3> brick(double x, double y, double z, double shear = 0.0) {
  std::vector<Vec3> points;
  for (const double h : {0.0, z}) {
    const double s = shear * h;
    points.insert(points.end(), {{s, 0, h}, {s + x, 0, h}, {s + x, y, h}, {s, y, h}});
  }
  return points;
}

TEST(CellMetrics, OfABrick) {
  const MeshQuality q = quality_of(ElementShape::hexahedron, brick(1, 2, 4));
  EXPECT_NEAR(metric(q, "scaled_jacobian").min, 1.0, eps);
  EXPECT_NEAR(metric(q, "edge_ratio").min, 4.0, eps);
  EXPECT_NEAR(metric(q, "volume").min, 8.0, eps);
  EXPECT_NEAR(metric(q, "skew").min, 0.0, eps);
  EXPECT_NEAR(metric(q, "min_angle").min, 90.0, eps);
  // Frobenius: |J| |J^-1| / 3 with the edge lengths on the diagonal.
  EXPECT_NEAR(metric(q, "aspect_frobenius").min,
              std::sqrt(1.0 + 4.0 + 16.0) * std::sqrt(1.0 + 1.0 / 4.0 + 1.0 / 16.0) / 3.0, eps);
  EXPECT_EQ(q.corner_angle.count, 24U);
  // Half of the corners' ratios are 1:2 and 2:4, a third each of 1:2, 1:4, 2:4, in both directions.
  EXPECT_NEAR(q.log_edge_ratio.max, std::log(4.0), eps);
  EXPECT_NEAR(q.log_edge_ratio.min, -std::log(4.0), eps);
}

// Edges at 60 degrees in one plane: the triple product is sin 60.
TEST(CellMetrics, OfAShearedBrick) {
  const double shear = 1.0 / std::tan(std::numbers::pi / 3.0);
  const MeshQuality q = quality_of(ElementShape::hexahedron, brick(1, 1, 1, shear));
  EXPECT_NEAR(metric(q, "scaled_jacobian").min, std::sqrt(3.0) / 2.0, eps);
  EXPECT_NEAR(metric(q, "min_angle").min, 60.0, 1e-9);
  EXPECT_NEAR(metric(q, "max_angle").max, 120.0, 1e-9);
  EXPECT_NEAR(metric(q, "volume").min, 1.0, eps);
  EXPECT_NEAR(metric(q, "skew").min, 0.5, 1e-9);  // cosine of the angle between the axes
}

TEST(CellMetrics, OfHexahedraThatAreNotValid) {
  std::vector<Vec3> inverted = brick(1, 1, 1);
  std::swap_ranges(inverted.begin(), inverted.begin() + 4, inverted.begin() + 4);
  EXPECT_NEAR(metric(quality_of(ElementShape::hexahedron, inverted), "scaled_jacobian").min, -1.0,
              eps);
  std::vector<Vec3> collapsed = brick(1, 1, 1);
  collapsed[1] = collapsed[0];
  EXPECT_EQ(metric(quality_of(ElementShape::hexahedron, collapsed), "scaled_jacobian").min, 0.0);
}

TEST(CellMetrics, OfTheRegularTetrahedron) {
  const MeshQuality q =
      quality_of(ElementShape::tetrahedron, {{1, 1, 1}, {-1, 1, -1}, {1, -1, -1}, {-1, -1, 1}});
  EXPECT_NEAR(std::abs(metric(q, "scaled_jacobian").min), 1.0, eps);
  EXPECT_NEAR(metric(q, "aspect_ratio").min, 1.0, eps);
  EXPECT_NEAR(metric(q, "edge_ratio").min, 1.0, eps);
  EXPECT_NEAR(metric(q, "min_angle").min, 60.0, 1e-9);
  EXPECT_NEAR(std::abs(metric(q, "volume").min), std::pow(std::sqrt(8.0), 3) / std::sqrt(72.0),
              eps);
}

TEST(CellMetrics, OfTheRightTetrahedron) {
  const MeshQuality q =
      quality_of(ElementShape::tetrahedron, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  EXPECT_NEAR(metric(q, "volume").min, 1.0 / 6.0, eps);
  // sqrt 2 times the triple product over the greatest product of edges at a corner: 1 * 2^(1/2)^2.
  EXPECT_NEAR(metric(q, "scaled_jacobian").min, std::sqrt(2.0) / 2.0, eps);
}

TEST(CellMetrics, OfIdealWedgesAndPyramids) {
  const double h = std::sqrt(3.0) / 2.0;
  const MeshQuality wedge = quality_of(
      ElementShape::wedge, {{0, 0, 0}, {1, 0, 0}, {0.5, h, 0}, {0, 0, 2}, {1, 0, 2}, {0.5, h, 2}});
  EXPECT_NEAR(metric(wedge, "scaled_jacobian").min, 1.0, eps);
  EXPECT_NEAR(metric(wedge, "volume").min, h, eps);
  EXPECT_NEAR(metric(wedge, "edge_ratio").min, 2.0, eps);
  const MeshQuality pyramid =
      quality_of(ElementShape::pyramid,
                 {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, std::sqrt(0.5)}});
  EXPECT_NEAR(metric(pyramid, "scaled_jacobian").min, 1.0, eps);
  EXPECT_NEAR(metric(pyramid, "volume").min, std::sqrt(0.5) / 3.0, eps);
  // At 45 degrees over a corner: the triple products there are those of a flat pyramid.
  const MeshQuality flat = quality_of(
      ElementShape::pyramid, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, -0.1}});
  EXPECT_LT(metric(flat, "scaled_jacobian").min, 0.0);
}

TEST(CellMetrics, OfSurfaceElements) {
  const MeshQuality triangle =
      quality_of(ElementShape::triangle, {{0, 0, 0}, {3, 0, 0}, {0, 4, 0}});
  EXPECT_FALSE(triangle.is_of_volume);
  EXPECT_NEAR(metric(triangle, "area").min, 6.0, eps);
  EXPECT_NEAR(metric(triangle, "edge_ratio").min, 5.0 / 3.0, eps);
  EXPECT_NEAR(metric(triangle, "min_angle").min, std::atan2(3, 4) * 180 / std::numbers::pi, 1e-9);
  EXPECT_NEAR(metric(triangle, "max_angle").max, 90.0, 1e-9);
  // Longest edge over 2 sqrt 3 times the inradius, which is 1.
  EXPECT_NEAR(metric(triangle, "aspect_ratio").min, 5.0 / (2.0 * std::sqrt(3.0)), eps);
  const double h = std::sqrt(3.0) / 2.0;
  const MeshQuality rhombus =
      quality_of(ElementShape::quad, {{0, 0, 0}, {1, 0, 0}, {1.5, h, 0}, {0.5, h, 0}});
  EXPECT_NEAR(metric(rhombus, "scaled_jacobian").min, h, eps);
  EXPECT_NEAR(metric(rhombus, "min_angle").min, 60.0, 1e-9);
  EXPECT_NEAR(metric(rhombus, "area").min, h, eps);
  const MeshQuality pentagon =
      quality_of(ElementShape::polygon, {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 2, 0}, {0, 1, 0}});
  EXPECT_NEAR(metric(pentagon, "area").min, 3.0, eps);
  EXPECT_NEAR(metric(pentagon, "max_angle").max, 135.0, 1e-9);
}

TEST(CellMetrics, SurfaceElementsOfAVolumeMeshAreLeftOut) {
  AnyMesh mesh = single(ElementShape::hexahedron, brick(1, 1, 1));
  mesh.add(ElementShape::quad, std::vector<int>{0, 1, 2, 3}, 7);
  const MeshQuality q = mesh_quality(mesh);
  EXPECT_TRUE(q.is_of_volume);
  EXPECT_EQ(metric(q, "scaled_jacobian").count, 1U);
  ASSERT_EQ(q.notes.size(), 1U);
  EXPECT_EQ(q.notes[0], "1 surface element is not measured: the cells are");
}

TEST(CellMetrics, TheWorstComeFirstWithTheirPlace) {
  AnyMesh mesh = bricks(4, 1, 1, [](const Vec3& p) {
    return p.x() == 2.0 && p.z() == 1.0 ? Vec3(p.x() + 0.5, p.y(), p.z()) : p;
  });
  const MeshQuality q = mesh_quality(mesh, 2);
  for (const MetricResult& result : q.metrics) {
    if (result.metric.name != "scaled_jacobian") continue;
    ASSERT_EQ(result.worst.size(), 2U);
    EXPECT_EQ(result.worst[0].what, "hexahedron");
    EXPECT_EQ(result.worst[0].label, 1);
    EXPECT_EQ(result.worst[1].label, 2);
    EXPECT_LE(result.worst[0].value, result.worst[1].value);
    EXPECT_NEAR(result.worst[0].at.y(), 0.5, eps);
    EXPECT_EQ(result.worst[0].value, result.all.min);
  }
}

}  // namespace
}  // namespace hexwall::test
