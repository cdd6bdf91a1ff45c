#include "surface/transfer.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include <gtest/gtest.h>

#include "surface/generate.h"

namespace hexwall {
namespace {

double linear(const Vec3& p) {
  return 3.0 * p.x() - 2.0 * p.y() + 0.5 * p.z() + 7.0;
}

SurfaceArray array_of(const TriangleSurface& surface) {
  SurfaceArray array{"linear and its square", 2, {}};
  for (const Vec3& p : surface.points) {
    array.values.push_back(linear(p));
    array.values.push_back(linear(p) * linear(p));
  }
  return array;
}

/// Each triangle in four, by its edges' midpoints, which lie on the surface.
TriangleSurface refined(const TriangleSurface& surface) {
  TriangleSurface result{surface.points, {}};
  std::map<std::pair<int, int>, int> middles;
  const auto middle = [&](int a, int b) {
    const auto [it, is_new] =
        middles.try_emplace(std::minmax(a, b), static_cast<int>(result.points.size()));
    if (is_new) result.points.push_back(0.5 * (surface.points[a] + surface.points[b]));
    return it->second;
  };
  for (const auto& [a, b, c] : surface.triangles) {
    const int ab = middle(a, b);
    const int bc = middle(b, c);
    const int ca = middle(c, a);
    for (const auto& t : {std::array{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}}) {
      result.triangles.push_back(t);
    }
  }
  return result;
}

TEST(Transfer, ReproducesLinearFunctionsOnARefinedCopy) {
  const TriangleSurface from = generate_shape(Shape::bifurcation, 0.3);
  const TriangleSurface to = refined(refined(from));
  const auto values = transfer_point_array(array_of(from), from, to);
  ASSERT_EQ(values.size(), 2 * to.points.size());
  for (std::size_t v = 0; v < to.points.size(); ++v) {
    EXPECT_NEAR(values[2 * v], linear(to.points[v]), 1e-12);
  }
}

TEST(Transfer, KeepsTheValueOfUnchangedVerticesExactly) {
  const TriangleSurface from = cylinder(1.0, 3.0, 16, 6);
  TriangleSurface to = from;
  std::reverse(to.points.begin(), to.points.end());  // other numbers, the same places
  const SurfaceArray array = array_of(from);
  const auto values = transfer_point_array(array, from, to);
  const std::size_t n = from.points.size();
  for (std::size_t v = 0; v < n; ++v) {
    EXPECT_EQ(values[2 * v], array.values[2 * (n - 1 - v)]);
    EXPECT_EQ(values[2 * v + 1], array.values[2 * (n - 1 - v) + 1]);
  }
}

TEST(Transfer, TakesTheNearestPointOfAMovedVertex) {
  const TriangleSurface from = annulus(1.0, 2.0, 24, 4);
  TriangleSurface to = refined(from);
  for (Vec3& p : to.points) p.z() += 0.01;
  const auto values = transfer_point_array(array_of(from), from, to);
  for (std::size_t v = 0; v < to.points.size(); ++v) {
    const Vec3 foot(to.points[v].x(), to.points[v].y(), 0.0);
    EXPECT_NEAR(values[2 * v], linear(foot), 1e-12);
  }
}

TEST(Transfer, StaysWithinTheValuesBesideTrianglesWithoutArea) {
  TriangleSurface from = annulus(1.0, 2.0, 24, 4);
  const auto [a, b, c] = from.triangles[0];
  const int middle = static_cast<int>(from.points.size());
  from.points.push_back(0.5 * (from.points[a] + from.points[b]));
  from.triangles.push_back({a, middle, b});
  from.triangles.push_back({c, c, a});
  SurfaceArray array{"one", 1, std::vector<double>(from.points.size(), 1.0)};
  for (const double value : transfer_point_array(array, from, refined(from))) {
    EXPECT_NEAR(value, 1.0, 1e-14);
  }
}

}  // namespace
}  // namespace hexwall
