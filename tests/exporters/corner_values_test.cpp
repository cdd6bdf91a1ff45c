// Values at corners of triangles as points of a file.

#include "exporters/corner_values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <variant>

#include <gtest/gtest.h>

#include "surface/generate.h"

namespace hexwall::test {
namespace {

const std::vector<double>& values_of(const PolyData& data, std::size_t array) {
  return std::get<std::vector<double>>(data.point_arrays[array].values);
}

// Two arrays on a tube: the angle around it, which jumps by a turn at the seam, and the height.
TEST(CornerValues, ShareAPointWhereTheyAgree) {
  const int around = 12;
  const int rows = 5;
  const TriangleSurface surface = cylinder(1.0, 3.0, around, rows);
  DataArray angle{"angle", 1, std::vector<double>{}};
  DataArray place{"place", 2, std::vector<double>{}};
  for (const auto& triangle : surface.triangles) {
    std::array<double, 3> angles;
    for (int k = 0; k < 3; ++k) {
      const Vec3& p = surface.points[triangle[k]];
      angles[k] = std::atan2(p.y(), p.x());
    }
    const double greatest = *std::max_element(angles.begin(), angles.end());
    for (int k = 0; k < 3; ++k) {
      const Vec3& p = surface.points[triangle[k]];
      // As it comes out of sums along different ways: not to the last digit.
      const double noise = 1e-14 * static_cast<double>(triangle[(k + 1) % 3]);
      const double turn = greatest - angles[k] > 3.0 ? 2.0 * std::numbers::pi : 0.0;
      std::get<0>(angle.values).push_back(angles[k] + turn + noise);
      std::get<0>(place.values).insert(std::get<0>(place.values).end(), {p.z(), p.x()});
    }
  }
  const PolyData data = with_corner_values(surface, {angle, place});
  EXPECT_EQ(data.points.size(), surface.points.size() + rows + 1);  // twice along the seam
  ASSERT_EQ(data.polygons.size(), surface.triangles.size());
  for (std::size_t c = 0; c < 3 * surface.triangles.size(); ++c) {
    const int point = data.polygons.connectivity()[c];
    EXPECT_EQ(data.points[point], surface.points[surface.triangles[c / 3][c % 3]]);
    EXPECT_NEAR(values_of(data, 0)[point], std::get<0>(angle.values)[c], 1e-8);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_EQ(values_of(data, 1)[2 * point + i], std::get<0>(place.values)[2 * c + i]);
    }
  }
}

}  // namespace
}  // namespace hexwall::test
