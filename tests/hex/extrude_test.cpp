#include "hex/extrude.h"

#include <cmath>
#include <numbers>
#include <random>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/errors.h"
#include "hex/column_quality.h"
#include "hex/directions.h"
#include "hex/skewness.h"
#include "hex/skin.h"
#include "hex/thickness.h"
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

/// Angle above the plane of the loop, in degrees, to which a direction at another is turned.
double turned_from(double angle) {
  Tube t = tube(12, 4, 1.0, 2.0);
  for (Vec3& d : t.directions) {
    d = std::cos(angle * pi / 180.0) * d - std::sin(angle * pi / 180.0) * Vec3::UnitZ();
  }
  const LoopPlane flat = fit_plane(circle(Vec3::Zero(), Vec3::UnitZ(), 1.0, 12));
  flatten_at_loops(t.quads, {flat, flat}, t.directions);
  EXPECT_GT(t.directions[0].x(), 0.0);
  return std::asin(-t.directions[0].z()) * 180.0 / pi;
}

TEST(FlattenAtLoops, TurnsDirectionsLessWhereTheSurfaceNearlyLiesInThePlane) {
  EXPECT_NEAR(turned_from(44.9), 0.0, 1e-9);
  EXPECT_NEAR(turned_from(45.1), 0.2, 1e-9);
  for (const double angle : {50.0, 60.0, 70.0, 80.0, 89.0}) {
    EXPECT_NEAR(turned_from(angle), 2.0 * (angle - 45.0), 1e-6) << angle;
  }
}

WallShape outward_shape(const Tube& t, double thickness, int layers = 3) {
  return {plan_layers(graded_layers(layers, 1.0, "layer_"), {}),
          std::vector<double>(t.quads.points.size(), thickness),
          {}};
}

WallShape inward_shape(const Tube& t, double thickness) {
  return {plan_layers({}, graded_layers(3, 1.0, "lumen_layer_")),
          {},
          std::vector<double>(t.quads.points.size(), thickness)};
}

double ring_volume(double inner, double outer) {
  return 12.0 * std::sin(2.0 * pi / 24) * (outer * outer - inner * inner) * 2.0;
}

/// Ring 0 leans along the tube so far that faces of a thin layer in it are too skewed; no other is.
TEST(Skewness, CountsTheFacesOfEndRings) {
  Tube t = tube(12, 4, 1.0, 2.0);
  const WallShape shape = outward_shape(t, 0.01, 1);
  const auto skewed_above = [&](double limit) {
    return Skewness(t.quads, shape.plan.levels)
        .quads_above(limit, column_edges(t.quads, t.directions, shape));
  };
  EXPECT_TRUE(skewed_above(1.0).empty());
  for (std::size_t v = 0; v < t.directions.size(); ++v) {
    if (t.quads.loop_of_vertex[v] != 0) continue;
    t.directions[v] = (t.directions[v] + 2.0 * Vec3::UnitZ()).normalized();
  }
  const std::vector<int> skewed = skewed_above(4.0);
  EXPECT_EQ(skewed.size(), 12U);
  for (const int q : skewed) EXPECT_LT(q, 12);
}

// After changes in some places it says the same as one that looks at all.
TEST(Skewness, IsComputedAgainWhereColumnsChange) {
  std::mt19937 random(1);
  const Tube t = tube(24, 20, 1.0, 2.0);
  const WallShape shape = outward_shape(t, 0.1);
  std::vector<ColumnEdge> columns = column_edges(t.quads, t.directions, shape);
  Skewness skewness(t.quads, shape.plan.levels);
  bool some = false;
  for (int round = 0; round < 20; ++round) {
    const std::vector<int> skewed = skewness.quads_above(1.0, columns);
    EXPECT_EQ(skewed, Skewness(t.quads, shape.plan.levels).quads_above(1.0, columns));
    some = some || (!skewed.empty() && skewed.size() < t.quads.quads.size() / 2);
    columns[random() % columns.size()].outward *= 3.0;
    columns[random() % columns.size()].base.z() += 0.05;
    Vec3& direction = columns[random() % columns.size()].direction;
    direction = (direction + Vec3::UnitZ()).normalized();
  }
  EXPECT_TRUE(some);
}

// The same, whatever changes.
TEST(ColumnQualities, AreFoundAgainWhereColumnsChange) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-0.02, 0.02);
  Tube t = tube(12, 20, 1.0, 2.0);
  WallShape shape = outward_shape(t, 0.1);
  ColumnQualities qualities;
  for (int round = 0; round < 20; ++round) {
    const auto columns = qualities.of(t.quads, t.directions, shape);
    ColumnQualities anew;
    const auto expected = anew.of(t.quads, t.directions, shape);
    ASSERT_EQ(columns.size(), expected.size());
    for (std::size_t q = 0; q < columns.size(); ++q) {
      EXPECT_EQ(columns[q].scaled_jacobian, expected[q].scaled_jacobian);
      EXPECT_EQ(columns[q].face_split, expected[q].face_split);
      EXPECT_EQ(columns[q].face_tet_margin, expected[q].face_tet_margin);
    }
    EXPECT_LE(least_scaled_jacobian(columns), columns[random() % columns.size()].scaled_jacobian);
    const std::size_t v = random() % shape.outward.size();
    if (round % 3 == 0) t.quads.points[v].x() += number(random);
    if (round % 3 == 1)
      t.directions[v] = (t.directions[v] + 10.0 * number(random) * Vec3::UnitZ()).normalized();
    if (round % 3 == 2) shape.outward[v] *= 1.2;
  }
}

// The same: faces meet in the middle of a tube whose layers are too thick there.
TEST(Skin, IsSearchedAgainWhereColumnsChange) {
  std::mt19937 random(1);
  const Tube t = tube(16, 60, 1.0, 8.0);
  std::vector<ColumnEdge> columns = column_edges(t.quads, t.directions, inward_shape(t, 0.9));
  Skin skin(t.quads, Side::inward);
  int clear = 0;
  int meeting = 0;
  for (int round = 0; round < 60; ++round) {
    const std::vector<int> quads = skin.collisions(columns, 1.0);
    EXPECT_EQ(quads, Skin(t.quads, Side::inward).collisions(columns, 1.0)) << round;
    ++(quads.empty() ? clear : meeting);
    for (const int q : quads) {
      if (random() % 3 == 0) continue;
      for (const int v : t.quads.quads[q]) columns[v].inward *= 0.9;
    }
    if (quads.empty()) {
      columns[random() % columns.size()].inward = 1.0;
      columns[random() % columns.size()].base.z() += 0.05;
    }
  }
  EXPECT_GT(clear, 3);
  EXPECT_GT(meeting, 10);
}

// The same of a whole fit, which finds columns too bad, too skewed, and in each other's way.
TEST(ThicknessFitter, FitsAgainWhereColumnsChange) {
  std::mt19937 random(1);
  Tube t = tube(16, 30, 1.0, 8.0);
  const WallShape shape = inward_shape(t, 0.8);
  ThicknessFitter fitter(t.quads, shape.plan, Side::inward);
  for (int round = 0; round < 12; ++round) {
    const ThicknessResult fit = fitter.fit(t.quads, t.directions, shape);
    const ThicknessResult anew = fit_thickness(t.quads, t.directions, shape, Side::inward);
    EXPECT_EQ(fit.given, anew.given) << round;
    EXPECT_EQ(fit.colliding_quads, anew.colliding_quads) << round;
    const std::size_t v = random() % t.directions.size();
    if (t.quads.loop_of_vertex[v] >= 0) continue;
    t.quads.points[v].z() += 0.04;
    t.directions[v] = (t.directions[v] + 0.4 * Vec3::UnitZ()).normalized();
  }
}

TEST(Extrude, FillsATubeOutward) {
  const Tube t = tube(24, 6, 1.0, 2.0);
  const HexMesh mesh = extrude(t.quads, t.directions, {"a", "b"}, outward_shape(t, 0.5));
  const HexVerdict verdict = verify_wall(mesh);
  EXPECT_TRUE(verdict.faults.none()) << verdict.faults.text();
  EXPECT_NEAR(verdict.hex_volume, ring_volume(1.0, 1.5), 1e-12);
}

TEST(Extrude, FillsATubeInward) {
  const Tube t = tube(24, 6, 1.0, 2.0);
  const HexMesh mesh = extrude(t.quads, t.directions, {"a", "b"}, inward_shape(t, 0.25));
  const HexVerdict verdict = verify_wall(mesh);
  EXPECT_TRUE(verdict.faults.none()) << verdict.faults.text();
  EXPECT_NEAR(verdict.hex_volume, ring_volume(0.75, 1.0), 1e-12);
  ASSERT_EQ(mesh.patches.size(), 4U);
  EXPECT_EQ(mesh.patches[0].name, "core");
  EXPECT_FALSE(mesh.patches[0].is_wall);
  EXPECT_EQ(mesh.patches[1].name, "wall");
  ASSERT_EQ(mesh.regions.size(), 1U);
  EXPECT_EQ(mesh.regions[0].name, "lumen");
  EXPECT_TRUE(mesh.face_zones.empty());
}

/// Two regions in one mesh; the interface is the surface, every quad of it once, and each of its
/// faces points from the lumen into the wall.
TEST(Extrude, JoinsBothSidesAtTheSurface) {
  const Tube t = tube(24, 6, 1.0, 2.0);
  WallShape shape = outward_shape(t, 0.5, 2);
  shape.plan = plan_layers(graded_layers(2, 1.0, "layer_"), graded_layers(3, 1.2, "lumen_layer_"));
  shape.inward.assign(t.quads.points.size(), 0.25);
  const HexMesh mesh = extrude(t.quads, t.directions, {"a", "b"}, shape);
  const HexVerdict verdict = verify_wall(mesh);
  EXPECT_TRUE(verdict.faults.none()) << verdict.faults.text();
  EXPECT_NEAR(verdict.hex_volume, ring_volume(0.75, 1.5), 1e-12);
  std::vector<std::string> names;
  for (const CellPatch& patch : mesh.patches) names.push_back(patch.name);
  EXPECT_EQ(names, (std::vector<std::string>{"core", "outer_wall", "a", "b", "a_wall", "b_wall"}));
  ASSERT_EQ(mesh.regions.size(), 2U);
  EXPECT_EQ(mesh.regions[0].cells.size(), 3 * t.quads.quads.size());
  EXPECT_EQ(mesh.regions[1].cells.size(), 2 * t.quads.quads.size());
  ASSERT_EQ(mesh.face_zones.size(), 1U);
  ASSERT_EQ(mesh.face_zones[0].faces.size(), t.quads.quads.size());
  for (std::size_t q = 0; q < t.quads.quads.size(); ++q) {
    const CellFace& face = mesh.face_zones[0].faces[q];
    for (int k = 0; k < 4; ++k) {
      EXPECT_EQ(mesh.points[face.vertices[k]], t.quads.points[t.quads.quads[q][k]]);
    }
    EXPECT_LT(mesh.layer[face.cell], 3);
  }
}

/// Into a tube there is room for less than its radius.
TEST(FitThickness, ThinsTheLayersWhereDirectionsMeet) {
  const Tube t = tube(24, 6, 1.0, 2.0);
  WallShape shape = inward_shape(t, 1.4);
  const ThicknessResult fit = fit_thickness(t.quads, t.directions, shape, Side::inward);
  EXPECT_NEAR(fit.reduced_area_fraction, 1.0, 1e-12);
  for (const double given : fit.given) EXPECT_TRUE(given > 0.0 && given < 1.0) << given;
  shape.inward = fit.given;
  const HexVerdict verdict = verify_wall(extrude(t.quads, t.directions, {"a", "b"}, shape));
  EXPECT_TRUE(verdict.faults.none()) << verdict.faults.text();
  EXPECT_GE(verdict.min_scaled_jacobian, 0.2 - 1e-12);
}

TEST(FitThickness, RefusesAFoldedSurfaceAndSaysWhere) {
  Tube t = tube(24, 6, 1.0, 2.0);
  t.quads.points[50] = t.quads.points[0];
  expect_error(ExitCode::meshing, {"no wall", "(", "smaller --size"},
               [&] { fit_thickness(t.quads, t.directions, outward_shape(t, 0.5), Side::outward); });
}

TEST(FitThickness, RefusesAThicknessThatIsOutOfAllProportion) {
  const Tube t = tube(24, 6, 1.0, 2.0);
  expect_error(ExitCode::meshing, {"no wall as thick as 1e+05", "across"},
               [&] { fit_thickness(t.quads, t.directions, inward_shape(t, 1e5), Side::inward); });
  expect_error(ExitCode::meshing, {"layers as thin as 1e-11", "lost in rounding"}, [&] {
    fit_thickness(t.quads, t.directions, outward_shape(t, 3e-11), Side::outward);
  });
}

}  // namespace
}  // namespace hexwall::test
