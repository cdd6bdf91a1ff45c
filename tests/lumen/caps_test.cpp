#include "lumen/caps.h"

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/errors.h"
#include "surface/loop_shape.h"

namespace hexwall {
namespace {

Vec3 tilted(double x, double y, double z) {
  return Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()) * Vec3(x, y, z) + Vec3(5, -3, 2);
}

std::vector<Vec3> ellipse(int n, double height) {
  std::vector<Vec3> loop;
  for (int i = 0; i < n; ++i) {
    const double t = 2.0 * std::numbers::pi * i / n;
    loop.push_back(tilted(2.0 * std::cos(t), std::sin(t), height * std::cos(2.0 * t)));
  }
  return loop;
}

std::vector<Vec3> all_points(const std::vector<Vec3>& rim, const Cap& cap) {
  std::vector<Vec3> points = rim;
  points.insert(points.end(), cap.points.begin(), cap.points.end());
  return points;
}

Vec3 area_vector(const std::vector<Vec3>& points, const std::array<int, 3>& t) {
  return 0.5 * (points[t[1]] - points[t[0]]).cross(points[t[2]] - points[t[0]]);
}

TEST(Cap, CoversAPlanarLoopOnceWithTrianglesOfItsSize) {
  const std::vector<Vec3> rim = ellipse(60, 0.0);
  const Cap cap = fill_loop(rim, "loop_0");
  const std::vector<Vec3> points = all_points(rim, cap);
  const LoopShape shape = loop_shape(rim);
  double area = 0.0;
  for (const auto& t : cap.triangles) {
    const Vec3 a = area_vector(points, t);
    EXPECT_GT(a.dot(shape.normal), 0.0);
    area += a.norm();
  }
  EXPECT_NEAR(area, shape.area, 1e-12 * shape.area);
  const double edge = shape.length / 60;
  const double of_regular = std::sqrt(3.0) / 4.0 * edge * edge;
  const double mean = area / static_cast<double>(cap.triangles.size());
  EXPECT_GT(mean, 0.5 * of_regular);
  EXPECT_LT(mean, 2.0 * of_regular);
  for (const Vec3& p : cap.points) {
    EXPECT_NEAR((p - shape.center).dot(shape.normal), 0.0, 1e-12);
  }
}

// By Euler's formula, a disc whose boundary has the rim's edges and no others.
TEST(Cap, PutsNoPointsOnTheRim) {
  const std::vector<Vec3> rim = ellipse(41, 0.0);
  const Cap cap = fill_loop(rim, "loop_0");
  EXPECT_EQ(cap.triangles.size(), rim.size() + 2 * cap.points.size() - 2);
}

// Vertices on a straight side of the loop lie on it but for rounding, this side or that.
TEST(Cap, FillsALoopWithACorner) {
  std::vector<Vec3> rim;
  for (int i = 0; i < 20; ++i) rim.push_back(tilted(0.1 * i, 0.0, 0.0));
  for (int i = 0; i < 10; ++i) rim.push_back(tilted(2.0, 0.1 * i, 0.0));
  for (int i = 0; i < 10; ++i) rim.push_back(tilted(2.0 - 0.1 * i, 1.0, 0.0));
  for (int i = 0; i < 10; ++i) rim.push_back(tilted(1.0, 1.0 + 0.1 * i, 0.0));
  for (int i = 0; i < 10; ++i) rim.push_back(tilted(1.0 - 0.1 * i, 2.0, 0.0));
  for (int i = 0; i < 20; ++i) rim.push_back(tilted(0.0, 2.0 - 0.1 * i, 0.0));
  const Cap cap = fill_loop(rim, "loop_0");
  const std::vector<Vec3> points = all_points(rim, cap);
  double area = 0.0;
  for (const auto& t : cap.triangles) {
    EXPECT_GT(area_vector(points, t).norm(), 1e-4);
    area += area_vector(points, t).norm();
  }
  EXPECT_NEAR(area, 3.0, 1e-12);
  EXPECT_EQ(cap.triangles.size(), rim.size() + 2 * cap.points.size() - 2);
}

// A harmonic surface has no height beyond those of its rim.
TEST(Cap, IsSmoothOverALoopThatIsNotPlanar) {
  const std::vector<Vec3> rim = ellipse(60, 0.2);
  const Cap cap = fill_loop(rim, "loop_0");
  const LoopShape shape = loop_shape(rim);
  for (const Vec3& p : cap.points) {
    EXPECT_LT(std::abs((p - shape.center).dot(shape.normal)), 0.2);
  }
}

TEST(Cap, ALoopThatMeetsItselfInItsPlaneIsRefusedByName) {
  std::vector<Vec3> rim;
  for (int i = 0; i < 40; ++i) {
    const double t = 2.0 * std::numbers::pi * i / 40;
    rim.push_back(tilted(2.0 * std::cos(t), std::sin(2.0 * t) + 0.2 * std::sin(t), 0.0));
  }
  try {
    fill_loop(rim, "iliac");
    FAIL() << "nothing was thrown";
  } catch (const MeshingError& error) {
    EXPECT_NE(std::string(error.what()).find("iliac"), std::string::npos);
  }
}

}  // namespace
}  // namespace hexwall
