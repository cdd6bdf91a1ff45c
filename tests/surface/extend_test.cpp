#include "surface/extend.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "support/expect_error.h"
#include "support/surfaces.h"
#include "surface/check.h"
#include "surface/connectivity.h"
#include "surface/generate.h"
#include "surface/loop_shape.h"

namespace hexwall {
namespace {

using std::numbers::pi;
using test::expect_error;

Connectivity connectivity(const TriangleSurface& surface) {
  return {static_cast<int>(surface.points.size()), surface.triangles};
}

/// Smallest 2 r_in / R_circ of the triangles of the extensions.
double min_quality(const ExtendResult& result) {
  double least = 1.0;
  for (std::size_t f = 0; f < result.extension.size(); ++f) {
    if (result.extension[f] < 0) continue;
    const auto& [a, b, c] = result.surface.triangles[f];
    const auto& p = result.surface.points;
    const Vec3 u = p[b] - p[a];
    const Vec3 v = p[c] - p[a];
    const double product = u.norm() * v.norm() * (u - v).norm();
    const double area = 0.5 * u.cross(v).norm();
    least =
        std::min(least, 16.0 * area * area / (product * (u.norm() + v.norm() + (u - v).norm())));
  }
  return least;
}

// What holds for every extended surface: the vessel is part of it as it was, the tubes continue its
// winding, ends are flat regular polygons, one per opening, of the opening's area.
void expect_valid(const TriangleSurface& vessel, const ExtendResult& result) {
  ASSERT_EQ(result.extension.size(), result.surface.triangles.size());
  ASSERT_GE(result.surface.triangles.size(), vessel.triangles.size());
  for (std::size_t v = 0; v < vessel.points.size(); ++v) {
    ASSERT_EQ(result.surface.points[v], vessel.points[v]);
  }
  for (std::size_t f = 0; f < result.extension.size(); ++f) {
    ASSERT_EQ(result.extension[f] < 0, f < vessel.triangles.size());
    if (f < vessel.triangles.size()) {
      ASSERT_EQ(result.surface.triangles[f], vessel.triangles[f]);
    }
  }
  const Connectivity before = connectivity(vessel);
  const Connectivity after = connectivity(result.surface);  // throws if the winding is wrong
  EXPECT_EQ(after.euler_number(), before.euler_number());
  ASSERT_EQ(after.loops().size(), before.loops().size());
  ASSERT_EQ(result.end_vertex.size(), before.loops().size());
  for (std::size_t i = 0; i < before.loops().size(); ++i) {
    const int loop = after.loop_of_vertex(result.end_vertex[i]);
    ASSERT_GE(loop, 0);
    const auto end = points_of(result.surface, after.loops()[loop]);
    const LoopShape shape = loop_shape(end);
    const LoopShape old = loop_shape(points_of(vessel, before.loops()[i]));
    EXPECT_EQ(end.size(), before.loops()[i].size());
    EXPECT_NEAR(shape.area, old.area, 1e-9 * old.area);
    EXPECT_NEAR(shape.normal.dot(old.normal), 1.0, 1e-12);
    for (const Vec3& p : end) {
      EXPECT_NEAR((p - shape.center).dot(shape.normal), 0.0, 1e-10 * old.radius);
      EXPECT_NEAR((p - shape.center).norm(), (end[0] - shape.center).norm(), 1e-9 * old.radius);
    }
  }
}

TEST(Extend, ContinuesACylinderAsACylinder) {
  const int n = 32;
  const double edge = 2.0 * std::sin(pi / n);
  const TriangleSurface tube = cylinder(1.0, 3.0, n, 18);
  for (const double k : {0.1, 1.0, 2.5, 10.0}) {
    const ExtendResult result = extend_openings(tube, k);
    expect_valid(tube, result);
    EXPECT_EQ(check_surface(result.surface).flipped, 0);
    // The staggered facets of a tube have a little more area than a prism of n sides.
    const double added = total_area(result.surface) - total_area(tube);
    EXPECT_NEAR(added, 2.0 * n * edge * k, 0.01 * n * edge * k);
    double low = 0.0;
    double high = 0.0;
    for (const Vec3& p : result.surface.points) {
      EXPECT_NEAR(std::hypot(p.x(), p.y()), 1.0, 1e-12);
      low = std::min(low, p.z());
      high = std::max(high, p.z());
    }
    EXPECT_NEAR(low, -k, 1e-12);
    EXPECT_NEAR(high, 3.0 + k, 1e-12);
    EXPECT_GT(min_quality(result), k < 0.2 ? 0.6 : 0.9);
  }
}

TEST(Extend, NumbersTheExtensionsAsTheLoops) {
  const TriangleSurface vessel = generate_shape(Shape::bifurcation, 0.25);
  const ExtendResult result = extend_openings(vessel, 1.0);
  const Connectivity mesh = connectivity(vessel);
  for (std::size_t f = vessel.triangles.size(); f < result.extension.size(); ++f) {
    const LoopShape own =
        loop_shape(points_of(vessel, mesh.loops()[static_cast<std::size_t>(result.extension[f])]));
    for (const int v : result.surface.triangles[f]) {
      const Vec3 p = result.surface.points[v] - own.center;
      EXPECT_LT(std::abs(p.dot(own.normal)), 1.01 * own.radius);
      EXPECT_LT(p.cross(own.normal).norm(), 1.1 * own.radius);
    }
  }
  EXPECT_EQ(result.notes.size(), 3U);
}

TEST(Extend, MakesEllipticEndsRoundOfTheSameArea) {
  TriangleSurface tube = cylinder(1.0, 4.0, 40, 30);
  for (Vec3& p : tube.points) p.x() *= 2.0;
  const ExtendResult result = extend_openings(tube, 3.0);
  expect_valid(tube, result);
  EXPECT_NO_THROW(check_surface(result.surface));
  EXPECT_GT(min_quality(result), 0.4);
  // After the blend, half way, the section is a circle of radius sqrt(2).
  for (std::size_t v = tube.points.size(); v < result.surface.points.size(); ++v) {
    const Vec3& p = result.surface.points[v];
    const double beyond = std::max(-p.z(), p.z() - 4.0);
    if (beyond < 0.51 * 3.0 * std::sqrt(2.0)) continue;
    EXPECT_NEAR(std::hypot(p.x(), p.y()), std::sqrt(2.0), 1e-9);
  }
}

TEST(Extend, LeavesObliqueEndsWithoutAFold) {
  for (const double slope : {0.3, 0.6, 1.0}) {  // up to 45°
    TriangleSurface tube = cylinder(1.0, 8.0, 32, 46);
    for (Vec3& p : tube.points) p.z() *= 1.0 + slope * p.x() / 8.0;
    const ExtendResult result = extend_openings(tube, 2.0);
    expect_valid(tube, result);
    EXPECT_NO_THROW(check_surface(result.surface));
    // Across each edge of the old loops the surface goes on within 25°.
    const Connectivity mesh = connectivity(result.surface);
    for (int h = 0; h < static_cast<int>(3 * tube.triangles.size()); ++h) {
      const int g = mesh.twin(h) < 0 ? -1 : Connectivity::face(mesh.twin(h));
      if (g < static_cast<int>(tube.triangles.size())) continue;
      const Vec3 a = doubled_area_vector(result.surface, Connectivity::face(h)).normalized();
      const Vec3 b = doubled_area_vector(result.surface, g).normalized();
      EXPECT_GT(a.dot(b), std::cos(25.0 * pi / 180.0)) << slope;
    }
  }
}

TEST(Extend, BlendsLoopsThatAreNotPlanar) {
  TriangleSurface tube = cylinder(1.0, 5.0, 32, 28);
  for (Vec3& p : tube.points) p.z() *= 1.0 + 0.06 * p.x() * p.y() + 0.04 * p.x() * p.x();
  const ExtendResult result = extend_openings(tube, 1.5);
  expect_valid(tube, result);
  EXPECT_NO_THROW(check_surface(result.surface));
  EXPECT_GT(min_quality(result), 0.5);
}

TEST(Extend, TakesLoopsOfUnevenEdges) {
  TriangleSurface tube = cylinder(1.0, 3.0, 32, 18);
  for (Vec3& p : tube.points) {
    const double angle = std::atan2(p.y(), p.x());
    const double moved = angle + 0.7 * std::sin(angle);  // edges from 0.3 to 1.7 of their length
    p = Vec3(std::cos(moved), std::sin(moved), p.z());
  }
  const ExtendResult result = extend_openings(tube, 2.0);
  expect_valid(tube, result);
  EXPECT_NO_THROW(check_surface(result.surface));
  EXPECT_GT(min_quality(result), 0.3);
}

TEST(Extend, IsTheSameInAnyPose) {
  const TriangleSurface vessel = generate_shape(Shape::bifurcation, 0.25);
  Eigen::Affine3d pose = Eigen::Affine3d::Identity();
  pose.translate(Vec3(5, -3, 2));
  pose.rotate(Eigen::AngleAxisd(1.1, Vec3(1, 2, -0.5).normalized()));
  pose.scale(100.0);
  TriangleSurface moved = vessel;
  for (Vec3& p : moved.points) p = pose * p;
  const ExtendResult here = extend_openings(vessel, 2.0);
  const ExtendResult there = extend_openings(moved, 2.0);
  ASSERT_EQ(here.surface.points.size(), there.surface.points.size());
  for (std::size_t v = 0; v < here.surface.points.size(); ++v) {
    EXPECT_LT((pose * here.surface.points[v] - there.surface.points[v]).norm(), 1e-9 * 100.0);
  }
  EXPECT_EQ(here.surface.triangles, there.surface.triangles);
  EXPECT_EQ(extend_openings(vessel, 2.0).surface.points, here.surface.points);  // bit for bit
}

TEST(Extend, RefusesTubesThatRunIntoTheVessel) {
  // Half a ring whose ends face each other over a gap of 2.
  TriangleSurface horseshoe = cylinder(0.8, 2.0 * pi * 0.9, 24, 60);
  for (Vec3& p : horseshoe.points) {
    const double angle = p.z();
    const double r = 3.0 + p.x();
    p = Vec3(r * std::cos(angle), r * std::sin(angle), p.y());
  }
  horseshoe = check_surface(horseshoe).surface;
  expect_error(ExitCode::geometry, {"the extension of the opening at", "runs into", "--extend"},
               [&] { extend_openings(horseshoe, 3.0); });
  EXPECT_NO_THROW(extend_openings(horseshoe, 0.5));
}

TEST(Extend, RefusesLengthsThatAreNone) {
  for (const double radii : {0.0, -1.0, std::nan("")}) {
    expect_error(ExitCode::usage, {"--extend", "positive"},
                 [&] { extend_openings(cylinder(1.0, 3.0, 16, 6), radii); });
  }
}

class Vessels : public testing::TestWithParam<std::string> {};

TEST_P(Vessels, AreExtendedOrRefusedWithTheReason) {
  const auto surface = test::load_surface(GetParam());
  if (!surface) GTEST_SKIP() << "there is no file of " << GetParam();
  const TriangleSurface vessel = check_surface(*surface).surface;
  try {
    const ExtendResult result = extend_openings(vessel, 2.0);
    expect_valid(vessel, result);
    EXPECT_EQ(check_surface(result.surface).flipped, 0);
    RecordProperty("min_quality", std::to_string(min_quality(result)));
  } catch (const GeometryError& error) {
    EXPECT_NE(std::string(error.what()).find("runs into"), std::string::npos) << error.what();
    RecordProperty("refused", error.what());
  }
}

INSTANTIATE_TEST_SUITE_P(Extend, Vessels, testing::ValuesIn(test::meshable_surfaces()),
                         test::test_name);

}  // namespace
}  // namespace hexwall
