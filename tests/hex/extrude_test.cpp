#include "hex/extrude.h"

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/errors.h"
#include "support/expect_error.h"
#include "support/verify_wall.h"

namespace hexwall::test {
namespace {

using std::numbers::pi;

std::vector<Vec3> circle(const Vec3& center, const Vec3& normal, double radius, int count) {
  const Vec3 u = normal.unitOrthogonal();
  const Vec3 v = normal.cross(u);
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) {
    const double angle = 2.0 * pi * i / count;
    points.push_back(center + radius * (std::cos(angle) * u + std::sin(angle) * v));
  }
  return points;
}

/// A tube along z of n x m quads, with its outward directions.
struct Tube {
  QuadMesh quads;
  std::vector<Vec3> directions;
};

Tube tube(int n, int m, double radius, double length) {
  Tube t;
  for (int j = 0; j <= m; ++j) {
    for (int i = 0; i < n; ++i) {
      const double angle = 2.0 * pi * i / n;
      t.directions.emplace_back(std::cos(angle), std::sin(angle), 0.0);
      t.quads.points.push_back(radius * t.directions.back() + Vec3(0, 0, length * j / m));
      t.quads.loop_of_vertex.push_back(j == 0 ? 0 : (j == m ? 1 : -1));
      if (j == m) continue;
      const int next = (i + 1) % n;
      t.quads.quads.push_back({j * n + i, j * n + next, (j + 1) * n + next, (j + 1) * n + i});
      t.quads.cylinder.push_back(0);
      t.quads.patch.push_back(0);
    }
  }
  return t;
}

TEST(FitPlane, FindsAPlaneAndARadius) {
  const Vec3 center(100.0, -20.0, 7.0);
  const Vec3 normal = Vec3(1.0, 2.0, -2.0) / 3.0;
  const LoopPlane plane = fit_plane(circle(center, normal, 3.0, 50));
  EXPECT_LT((plane.center - center).norm(), 1e-12);
  EXPECT_NEAR(std::abs(plane.normal.dot(normal)), 1.0, 1e-12);
  EXPECT_NEAR(plane.radius, 3.0, 1e-12);
  EXPECT_LT(plane.deviation, 1e-12);
  EXPECT_TRUE(plane.is_planar());
}

TEST(FitPlane, SaysHowFarALoopIsFromIt) {
  std::vector<Vec3> loop = circle(Vec3::Zero(), Vec3::UnitZ(), 2.0, 40);
  for (std::size_t i = 0; i < loop.size(); ++i) {
    loop[i].z() = 0.1 * std::cos(4.0 * pi * static_cast<double>(i) / 40.0);
  }
  const LoopPlane plane = fit_plane(loop);
  EXPECT_NEAR(plane.deviation, 0.1, 1e-9);
  EXPECT_FALSE(plane.is_planar());
}

TEST(FlattenAtLoops, TurnsDirectionsIntoThePlaneOfTheLoop) {
  Tube t = tube(12, 4, 1.0, 2.0);
  for (Vec3& direction : t.directions) direction = (direction + Vec3(0, 0, 0.5)).normalized();
  const std::vector<Vec3> before = t.directions;
  const LoopPlane flat = fit_plane(circle(Vec3::Zero(), Vec3::UnitZ(), 1.0, 12));
  LoopPlane bent = flat;
  bent.deviation = 0.5;
  flatten_at_loops(t.quads, {flat, bent}, t.directions);
  for (std::size_t v = 0; v < t.directions.size(); ++v) {
    EXPECT_NEAR(t.directions[v].norm(), 1.0, 1e-12);
    if (t.quads.loop_of_vertex[v] == 0) {
      EXPECT_NEAR(t.directions[v].z(), 0.0, 1e-12);
      EXPECT_GT(t.directions[v].dot(t.quads.points[v]), 0.99);
    } else {
      EXPECT_EQ(t.directions[v], before[v]);
    }
  }
}

TEST(FlattenAtLoops, KeepsDirectionsAcrossThePlaneOfTheLoop) {
  Tube t = tube(12, 4, 1.0, 2.0);
  t.directions.assign(t.directions.size(), Vec3::UnitZ());
  const LoopPlane flat = fit_plane(circle(Vec3::Zero(), Vec3::UnitZ(), 1.0, 12));
  flatten_at_loops(t.quads, {flat, flat}, t.directions);
  for (const Vec3& direction : t.directions) EXPECT_EQ(direction, Vec3(Vec3::UnitZ()));
}

TEST(Extrude, FillsATube) {
  const Tube t = tube(24, 6, 1.0, 2.0);
  ExtrudeOptions options;
  options.thickness = 0.5;
  options.layers = 3;
  const ExtrudeResult result = extrude(t.quads, t.directions, {"a", "b"}, options);
  const HexVerdict verdict = verify_wall(result.mesh);
  EXPECT_TRUE(verdict.faults.none()) << verdict.faults.text();
  EXPECT_NEAR(verdict.hex_volume, 12.0 * std::sin(2.0 * pi / 24) * (1.5 * 1.5 - 1.0) * 2.0, 1e-12);
  EXPECT_EQ(result.thickness_min, 0.5);
  EXPECT_EQ(result.reduced_area_fraction, 0.0);
}

/// Into a tube there is room for less than its radius.
TEST(Extrude, ThinsTheWallWhereDirectionsMeet) {
  Tube t = tube(24, 6, 1.0, 2.0);
  for (Vec3& direction : t.directions) direction = -direction;
  for (auto& quad : t.quads.quads) std::swap(quad[1], quad[3]);
  ExtrudeOptions options;
  options.thickness = 3.0;
  const ExtrudeResult result = extrude(t.quads, t.directions, {"a", "b"}, options);
  const HexVerdict verdict = verify_wall(result.mesh);
  EXPECT_TRUE(verdict.faults.none()) << verdict.faults.text();
  EXPECT_LT(result.thickness_min, 1.0);
  EXPECT_NEAR(result.reduced_area_fraction, 1.0, 1e-12);
}

TEST(Extrude, RefusesAFoldedSurfaceAndSaysWhere) {
  Tube t = tube(24, 6, 1.0, 2.0);
  t.quads.points[50] = t.quads.points[0];
  expect_error(ExitCode::meshing, {"no wall", "(", "smaller --size"}, [&] {
    extrude(t.quads, t.directions, {"a", "b"}, {});
  });
}

TEST(Extrude, RefusesAThicknessThatIsOutOfAllProportion) {
  Tube t = tube(24, 6, 1.0, 2.0);
  for (Vec3& direction : t.directions) direction = -direction;
  for (auto& quad : t.quads.quads) std::swap(quad[1], quad[3]);
  ExtrudeOptions options;
  options.thickness = 1e5;
  expect_error(ExitCode::meshing, {"no wall of positive thickness"}, [&] {
    extrude(t.quads, t.directions, {"a", "b"}, options);
  });
}

}  // namespace
}  // namespace hexwall::test
