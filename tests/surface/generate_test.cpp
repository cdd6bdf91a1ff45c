#include "surface/generate.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "support/expect_error.h"
#include "surface/check.h"
#include "surface/connectivity.h"
#include "surface/vessel_field.h"
#include "surface/vessel_shapes.h"
#include "surface/vessel_tree.h"

namespace hexwall {
namespace {

using std::numbers::pi;
using test::expect_error;

/// Twice the ratio of the radii of inscribed and circumscribed circle: 1 if equilateral.
double quality(const TriangleSurface& surface, int f) {
  const auto& [i, j, k] = surface.triangles[f];
  const double a = (surface.points[j] - surface.points[i]).norm();
  const double b = (surface.points[k] - surface.points[j]).norm();
  const double c = (surface.points[i] - surface.points[k]).norm();
  return (b + c - a) * (c + a - b) * (a + b - c) / (a * b * c);
}

double worst_quality(const TriangleSurface& surface) {
  double worst = 1.0;
  for (int f = 0; f < static_cast<int>(surface.triangles.size()); ++f) {
    worst = std::min(worst, quality(surface, f));
  }
  return worst;
}

double mean_edge(const TriangleSurface& surface) {
  const Connectivity mesh = connectivity_of(surface);
  double sum = 0.0;
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const int h = mesh.halfedge(e);
    sum += (surface.points[mesh.tip(h)] - surface.points[mesh.tail(h)]).norm();
  }
  return sum / mesh.edge_count();
}

/// Valid as it is, of the given number of loops, and of genus 0.
void expect_vessel(const TriangleSurface& surface, int loops) {
  const CheckResult result = check_surface(surface);
  EXPECT_EQ(result.flipped, 0);
  const Connectivity mesh = connectivity_of(surface);
  EXPECT_EQ(static_cast<int>(mesh.loops().size()), loops);
  EXPECT_EQ(mesh.euler_number(), 2 - loops);
}

/// Each loop in the plane of one open end and around it; each end with one loop.
void expect_flat_ends(const TriangleSurface& surface, const VesselField& field) {
  const Connectivity mesh = connectivity_of(surface);
  std::vector<int> loops_at(field.ends().size(), 0);
  for (const std::vector<int>& loop : mesh.loops()) {
    Vec3 centroid = Vec3::Zero();
    for (const int v : loop) centroid += surface.points[v] / static_cast<double>(loop.size());
    std::size_t nearest = 0;
    for (std::size_t i = 1; i < field.ends().size(); ++i) {
      if ((field.ends()[i].center - centroid).norm() <
          (field.ends()[nearest].center - centroid).norm()) {
        nearest = i;
      }
    }
    ++loops_at[nearest];
    const OpenEnd& end = field.ends()[nearest];
    for (const int v : loop) {
      const Vec3 arm = surface.points[v] - end.center;
      EXPECT_NEAR(arm.dot(end.direction), 0.0, 1e-9 * end.radius);
      EXPECT_NEAR(arm.norm(), end.radius, 0.01 * end.radius);
    }
  }
  for (const int count : loops_at) EXPECT_EQ(count, 1);
}

void expect_on_field(const TriangleSurface& surface, const VesselField& field) {
  for (const Vec3& p : surface.points) EXPECT_NEAR(field(p).value, 0.0, 1e-8);
}

// --- plane and developable shapes ---------------------------------------------------------------

TEST(Annulus, HasItsVerticesOnTheCircles) {
  const TriangleSurface surface = annulus(0.5, 3.0, 30, 7);
  expect_vessel(surface, 2);
  ASSERT_EQ(surface.points.size(), 240U);
  for (int i = 0; i < 30; ++i) {
    EXPECT_NEAR(surface.points[i].norm(), 0.5, 1e-15);
    EXPECT_NEAR(surface.points[210 + i].norm(), 3.0, 1e-15);
  }
}

TEST(Annulus, FacesUpAndCoversTheAreaToSecondOrder) {
  const double area = 3.0 * pi;
  double previous = 0.0;
  for (const int n : {16, 32, 64}) {
    const TriangleSurface surface = annulus(1.0, 2.0, n, n / 8);
    for (int f = 0; f < static_cast<int>(surface.triangles.size()); ++f) {
      EXPECT_GT(doubled_area_vector(surface, f).z(), 0.0);
    }
    const double error = area - total_area(surface);
    if (previous > 0.0) {
      EXPECT_NEAR(previous / error, 4.0, 0.1);
    }
    previous = error;
  }
}

TEST(Annulus, HasSimilarTriangles) {
  const TriangleSurface surface = annulus(1.0, 2.0, 40, 6);
  for (int f = 0; f < static_cast<int>(surface.triangles.size()); f += 2) {
    EXPECT_NEAR(quality(surface, f), quality(surface, f % 4 == 0 ? 0 : 2), 0.05);
  }
}

TEST(EccentricAnnulus, HasItsVerticesOnTheCircles) {
  const TriangleSurface surface = eccentric_annulus(1.0, 0.3, 0.4, 36, 8);
  expect_vessel(surface, 2);
  for (int i = 0; i < 36; ++i) {
    EXPECT_NEAR((surface.points[i] - Vec3(0.4, 0, 0)).norm(), 0.3, 1e-15);
    EXPECT_NEAR(surface.points[8 * 36 + i].norm(), 1.0, 1e-15);
  }
  for (int f = 0; f < static_cast<int>(surface.triangles.size()); ++f) {
    EXPECT_GT(doubled_area_vector(surface, f).z(), 0.0);
  }
}

TEST(Cylinder, FacesOutAndHasFlatEnds) {
  const TriangleSurface surface = cylinder(2.0, 5.0, 24, 9);
  expect_vessel(surface, 2);
  for (const Vec3& p : surface.points) EXPECT_NEAR(std::hypot(p.x(), p.y()), 2.0, 1e-15);
  for (int i = 0; i < 24; ++i) {
    EXPECT_EQ(surface.points[i].z(), 5.0);
    EXPECT_EQ(surface.points[9 * 24 + i].z(), 0.0);
  }
}

// --- names and options --------------------------------------------------------------------------

TEST(GenerateShape, KnowsItsNames) {
  EXPECT_EQ(shape_from_name("annulus"), Shape::annulus);
  EXPECT_EQ(shape_from_name("eccentric-annulus"), Shape::eccentric_annulus);
  EXPECT_EQ(shape_from_name("cylinder"), Shape::cylinder);
  EXPECT_EQ(shape_from_name("bifurcation"), Shape::bifurcation);
  EXPECT_EQ(shape_from_name("aaa"), Shape::aaa);
  expect_error(ExitCode::usage,
               {"'torus'", "annulus", "eccentric-annulus", "cylinder", "bifurcation", "aaa"},
               [] { shape_from_name("torus"); });
}

TEST(GenerateShape, RefusesBadEdgeLengths) {
  for (const double edge : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    expect_error(ExitCode::usage, {"positive"}, [&] { generate_shape(Shape::annulus, edge); });
  }
  for (const Shape shape : {Shape::annulus, Shape::eccentric_annulus, Shape::cylinder,
                            Shape::bifurcation, Shape::aaa}) {
    expect_error(ExitCode::usage, {"too long", "at most"}, [&] { generate_shape(shape, 50.0); });
    expect_error(ExitCode::usage, {"too short"}, [&] { generate_shape(shape, 1e-9); });
  }
}

class SimpleShapes : public testing::TestWithParam<Shape> {};

TEST_P(SimpleShapes, AreValidAndFollowTheEdgeLength) {
  for (const double edge : {0.1, 0.2}) {
    const TriangleSurface surface = generate_shape(GetParam(), edge);
    expect_vessel(surface, GetParam() == Shape::bifurcation ? 3 : 2);
    EXPECT_NEAR(mean_edge(surface), edge, 0.25 * edge);
    // The narrow side of the eccentric annulus is the worst.
    EXPECT_GT(worst_quality(surface), 0.25);
  }
}

INSTANTIATE_TEST_SUITE_P(GenerateShape, SimpleShapes,
                         testing::Values(Shape::annulus, Shape::eccentric_annulus, Shape::cylinder,
                                         Shape::bifurcation));

// --- vessel trees -------------------------------------------------------------------------------

TEST(VesselField, IsTheDistanceToATaperedTube) {
  const VesselField field({{{{0, 0, 0}, {0, 0, 10}}, {2.0, 1.0}, false, false, 0.0}});
  // The hull of the balls is a cone whose sides lean by asin(1/10).
  const double cosine = std::sqrt(1.0 - 0.01);
  EXPECT_NEAR(field({1.5 / cosine, 0, 5}).value, 0.0, 1e-12);
  EXPECT_NEAR(field({0, 0, -3}).value, 1.0, 1e-12);
  EXPECT_NEAR(field({0, 0, 13}).value, 2.0, 1e-12);
}

TEST(VesselField, GradientIsTheDerivative) {
  const VesselField field(bifurcation_branches());
  const double step = 1e-6;
  for (const Vec3& x : {Vec3(0.1, 0.9, 2.0), Vec3(0.05, 0.7, -1.2), Vec3(2.0, 0.8, -2.0)}) {
    for (int k = 0; k < 3; ++k) {
      const Vec3 shift = step * Vec3::Unit(k);
      const double slope = (field(x + shift).value - field(x - shift).value) / (2.0 * step);
      EXPECT_NEAR(field(x).gradient[k], slope, 1e-6);
    }
  }
}

TEST(VesselTree, StraightBranchIsACylinder) {
  const Branch branch{{{1, 2, 3}, {1, 2, 9}}, {1.5, 1.5}, true, true, 0.0};
  const TriangleSurface surface = vessel_tree({branch}, 0.2);
  expect_vessel(surface, 2);
  for (const Vec3& p : surface.points) {
    EXPECT_NEAR(std::hypot(p.x() - 1, p.y() - 2), 1.5, 1e-9);
    EXPECT_GE(p.z(), 3.0 - 1e-9);
    EXPECT_LE(p.z(), 9.0 + 1e-9);
  }
  EXPECT_NEAR(total_area(surface), 2.0 * pi * 1.5 * 6.0, 0.01 * 2.0 * pi * 1.5 * 6.0);
}

TEST(VesselTree, MakesShortStubs) {
  const std::vector<Branch> branches{{{{0, 0, -3}, {0, 0, 3}}, {1.0, 1.0}, true, true, 0.0},
                                     {{{0, 0, 0}, {1.7, 0, 0}}, {0.6, 0.6}, false, true, 0.3}};
  const TriangleSurface surface = vessel_tree(branches, 0.15);
  expect_vessel(surface, 3);
  expect_flat_ends(surface, VesselField(branches));
  EXPECT_GT(worst_quality(surface), 0.3);
}

TEST(VesselTree, RefusesEdgesLongerThanTheThinnestRadius) {
  const Branch branch{{{0, 0, 0}, {0, 0, 9}}, {1.5, 0.5}, true, true, 0.0};
  expect_error(ExitCode::usage, {"too long", "0.5"}, [&] { vessel_tree({branch}, 0.6); });
}

TEST(VesselTree, BifurcationLiesOnItsField) {
  const TriangleSurface surface = generate_shape(Shape::bifurcation, 0.2);
  const VesselField field(bifurcation_branches());
  expect_on_field(surface, field);
  expect_flat_ends(surface, field);
}

TEST(VesselTree, IsTheSameEveryTime) {
  const TriangleSurface a = generate_shape(Shape::bifurcation, 0.25);
  const TriangleSurface b = generate_shape(Shape::bifurcation, 0.25);
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.triangles, b.triangles);
}

TEST(Aaa, HasTenFlatEndsAndTheExpectedSize) {
  const TriangleSurface surface = generate_shape(Shape::aaa);
  EXPECT_NEAR(static_cast<double>(surface.points.size()), 26165.0, 0.02 * 26165.0);
  expect_vessel(surface, 10);
  const VesselField field(aaa_branches());
  expect_on_field(surface, field);
  expect_flat_ends(surface, field);
  EXPECT_GT(worst_quality(surface), 0.3);
}

}  // namespace
}  // namespace hexwall
