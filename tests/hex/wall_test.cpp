// The hexahedral wall of every surface that can be meshed, and of a cylinder, whose wall is known.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <ostream>

#include <gtest/gtest.h>

#include "pipeline.h"
#include "support/surfaces.h"
#include "support/verify_wall.h"
#include "surface/generate.h"

namespace hexwall::test {
namespace {

using std::numbers::pi;

class WallOfSurface : public testing::TestWithParam<std::string> {};

TEST_P(WallOfSurface, IsValidAndAsReported) {
  const auto surface = load_surface(GetParam());
  if (!surface) GTEST_SKIP() << GetParam() << " is not on this machine";
  expect_valid_wall(run_pipeline(*surface, {}));
}

INSTANTIATE_TEST_SUITE_P(, WallOfSurface, testing::ValuesIn(meshable_surfaces()), test_name);

double least_given(const PipelineResult& r) {
  return *std::min_element(r.outward->given.begin(), r.outward->given.end());
}

/// A cylinder of radius 2 and length 5, the triangles a quarter of the size of the quads.
PipelineResult cylinder_wall(double size, PipelineOptions options = {}) {
  const double edge = 0.25 * size;
  const int around = static_cast<int>(std::lround(4.0 * pi / edge));
  const int along = static_cast<int>(std::lround(5.0 / (0.5 * std::numbers::sqrt3 * edge)));
  options.size = size;
  return run_pipeline(cylinder(2.0, 5.0, around, along), options);
}

TEST(WallOfCylinder, VolumeConvergesToSecondOrder) {
  PipelineOptions options;
  options.outward->thickness = 0.3;
  const double exact = pi * (2.3 * 2.3 - 2.0 * 2.0) * 5.0;
  std::vector<double> errors;
  for (const double size : {0.8, 0.4, 0.2}) {
    const PipelineResult r = cylinder_wall(size, options);
    const HexVerdict verdict = verify_wall(r.wall);
    EXPECT_TRUE(verdict.faults.none()) << verdict.faults.text();
    errors.push_back(std::abs(verdict.hex_volume - exact) / exact);
  }
  EXPECT_LT(errors.back(), 5e-3);
  // Sizes are halved up to the rounding of the number of quads around.
  EXPECT_GT(std::log2(errors[0] / errors[1]), 1.7);
  EXPECT_GT(std::log2(errors[1] / errors[2]), 1.7);
}

TEST(WallOfCylinder, HasFlatEndRings) {
  const PipelineResult r = cylinder_wall(0.4);
  ASSERT_EQ(r.openings.size(), 2U);
  for (std::size_t loop = 0; loop < 2; ++loop) {
    const double z = r.openings[loop].plane.center.z();
    EXPECT_TRUE(std::abs(z) < 1e-9 || std::abs(z - 5.0) < 1e-9) << z;
    for (const CellFace& face : r.wall.patches[loop + 2].faces) {
      for (const int v : face.vertices) EXPECT_NEAR(r.wall.points[v].z(), z, 1e-9);
    }
  }
}

TEST(WallOfCylinder, HasTheThicknessAndLayersAskedFor) {
  PipelineOptions options;
  options.outward->thickness = 0.25;
  options.outward->layers = 5;
  const PipelineResult r = cylinder_wall(0.4, options);
  expect_valid_wall(r);
  EXPECT_EQ(r.wall.zones.size(), 5U);
  EXPECT_DOUBLE_EQ(least_given(r), 0.25);
  EXPECT_EQ(r.outward->reduced_area_fraction, 0.0);
  EXPECT_TRUE(r.warnings.empty());
  for (const Vec3& p : r.wall.points) {
    const double radius = std::hypot(p.x(), p.y());
    EXPECT_GT(radius, 2.0 - 0.01);
    EXPECT_LT(radius, 2.25 + 1e-9);
  }
}

TEST(WallOfCylinder, DefaultThicknessIsATenthOfTheRadius) {
  const PipelineResult r = cylinder_wall(0.2);
  EXPECT_NEAR(*r.options.outward->thickness, 0.2, 0.01);
}

class Growth : public testing::TestWithParam<double> {};

TEST_P(Growth, IsTheRatioOfSuccessiveLayers) {
  PipelineOptions options;
  options.outward->thickness = 0.3;
  options.outward->layers = 4;
  options.outward->growth = GetParam();
  const PipelineResult r = cylinder_wall(0.4, options);
  expect_valid_wall(r);
  const HexMesh& mesh = r.wall;
  std::vector<std::array<double, 4>> heights(r.quads.quads.size());
  for (int h = 0; h < mesh.cells(); ++h) {
    heights[mesh.quad[h]][mesh.layer[h]] =
        (mesh.points[mesh.corners(h)[4]] - mesh.points[mesh.corners(h)[0]]).norm();
  }
  for (const auto& height : heights) {
    for (int k = 1; k < 4; ++k) ASSERT_NEAR(height[k] / height[k - 1], GetParam(), 1e-9);
    ASSERT_NEAR(height[0] + height[1] + height[2] + height[3], 0.3, 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(, Growth, testing::Values(0.5, 1.0, 1.2, 2.0));

/// Planar loops of a surface with branches: the wall's end rings stay in the planes.
TEST(WallOfBifurcation, HasFlatEndRings) {
  const PipelineResult r = run_pipeline(generate_shape(Shape::bifurcation), {});
  const double tolerance = 1e-9 * bounding_box_diagonal(r.surface);
  for (std::size_t loop = 0; loop < r.openings.size(); ++loop) {
    const LoopPlane& plane = r.openings[loop].plane;
    ASSERT_TRUE(plane.is_planar());
    EXPECT_LT(plane.deviation, tolerance);
    for (const CellFace& face : r.wall.patches[loop + 2].faces) {
      for (const int v : face.vertices) {
        EXPECT_NEAR((r.wall.points[v] - plane.center).dot(plane.normal), 0.0, tolerance);
      }
    }
  }
}

/// A wall as thick as the branches are wide does not fit into the crotch: it gets thinner there,
/// says so, and stays valid.
TEST(WallOfBifurcation, IsThinnerInTheCrotchWhereItHasToBe) {
  PipelineOptions options;
  options.outward->thickness = 1.0;
  options.size = 0.1;
  const PipelineResult r = run_pipeline(generate_shape(Shape::bifurcation), options);
  expect_valid_wall(r);
  EXPECT_EQ(*r.options.outward->thickness, 1.0);
  EXPECT_LT(least_given(r), 0.99);
  EXPECT_GT(r.outward->reduced_area_fraction, 0.0);
  EXPECT_LT(r.outward->reduced_area_fraction, 0.5);
  EXPECT_NEAR(r.outward->given[r.outward->worst_vertex], least_given(r), 1e-12);
  ASSERT_EQ(r.warnings.size(), 1U);
  EXPECT_NE(r.warnings[0].find("instead of 1"), std::string::npos) << r.warnings[0];
  // Far from the crotch, at the ends, nothing is missing.
  for (std::size_t v = 0; v < r.quads.points.size(); ++v) {
    if (r.quads.loop_of_vertex[v] < 0) continue;
    EXPECT_DOUBLE_EQ(r.outward->given[v], 1.0);
  }
}

class Layers : public testing::TestWithParam<int> {};

TEST_P(Layers, AreCompleteWhereTheWallIsThin) {
  PipelineOptions options;
  options.outward->thickness = 1.0;
  options.size = 0.2;
  options.outward->layers = GetParam();
  expect_valid_wall(run_pipeline(generate_shape(Shape::bifurcation), options));
}

INSTANTIATE_TEST_SUITE_P(, Layers, testing::Values(1, 2, 7));

/// However thick a wall is asked for, as much as fits comes out.
class Thickness : public testing::TestWithParam<double> {};

TEST_P(Thickness, IsReducedToWhatFits) {
  PipelineOptions options;
  options.outward->thickness = GetParam();
  options.size = 0.25;
  expect_valid_wall(run_pipeline(generate_shape(Shape::bifurcation, 0.25), options));
}

INSTANTIATE_TEST_SUITE_P(, Thickness, testing::Values(0.01, 0.5, 1.0, 2.0, 4.0));

struct Goal {
  const char* surface;
  double size;  ///< 0: the default
  std::size_t loops, cylinders;
  int zeros, strips;
  double energy;
  std::size_t poles;
};

void PrintTo(const Goal& goal, std::ostream* out) {
  *out << goal.surface;
}

class Goals : public testing::TestWithParam<Goal> {};

TEST_P(Goals, AreReached) {
  const Goal& goal = GetParam();
  const auto surface = load_surface(goal.surface);
  if (!surface) GTEST_SKIP() << goal.surface << " is not on this machine";
  PipelineOptions options;
  if (goal.size > 0.0) options.size = goal.size;
  const PipelineResult r = run_pipeline(*surface, options);
  EXPECT_EQ(r.openings.size(), goal.loops);
  EXPECT_EQ(r.foliation.interior_zeros(), goal.zeros);
  EXPECT_EQ(r.foliation.boundary_half_zeros(), 0);
  EXPECT_EQ(r.foliation.cylinders.size(), goal.cylinders);
  EXPECT_EQ(r.foliation.strips.count(), goal.strips);
  EXPECT_LE(r.solution.optimum.energy, goal.energy);
  EXPECT_LE(r.quad_quality.angle_stddev_deg, 3.5);
  EXPECT_GE(r.quad_quality.min_scaled_jacobian, 0.4);
  expect_valid_wall(r);
  EXPECT_EQ(r.poles.size(), goal.poles);
}

INSTANTIATE_TEST_SUITE_P(, Goals,
                         testing::Values(Goal{"aaa", 0.0, 10, 17, 8, 16, 0.21, 0},
                                         Goal{"aneurysm", 0.8, 3, 5, 2, 4, 0.13, 1}),
                         [](const auto& test) { return std::string(test.param.surface); });

/// Four layers of 0.125 on about 10,000 quads: better on both sides, in the worst corner, than
/// quads of QuadWild-BiMDF through OpenFOAM's extrudeMesh, which come to 0.417 outside and 0.608
/// inside. Where rows of quads come to lie is chance: of five sizes, the one in the middle counts.
TEST(WorstHex, IsBetterThanThatOfOtherTools) {
  const auto surface = load_surface("aneurysm");
  if (!surface) GTEST_SKIP() << "the aneurysm of gmsh-doc is not on this machine";
  LayerOptions layers;
  layers.thickness = 0.5;
  layers.layers = 4;
  const auto median = [&](auto side) {
    std::vector<double> worst;
    for (const double size : {0.67, 0.675, 0.68, 0.685, 0.69}) {
      PipelineOptions options;
      options.size = size;
      options.outward.reset();
      options.*side = layers;
      worst.push_back(run_pipeline(*surface, options).min_wall_scaled_jacobian);
    }
    std::sort(worst.begin(), worst.end());
    return worst[2];
  };
  EXPECT_GT(median(&PipelineOptions::outward), 0.55);
  EXPECT_GT(median(&PipelineOptions::inward), 0.608);
}

/// Without poles the tip of the aneurysm's sac is cut off: the user has to be told.
TEST(WithoutPoles, ACutOffTipIsTold) {
  const auto surface = load_surface("aneurysm");
  if (!surface) GTEST_SKIP() << "the aneurysm of gmsh-doc is not on this machine";
  PipelineOptions options;
  options.size = 0.8;
  options.poles.mode = PoleRequest::Mode::off;
  const PipelineResult r = run_pipeline(*surface, options);
  EXPECT_LT(r.quad_quality.area, 0.98 * total_area(r.surface));
  EXPECT_TRUE(std::any_of(r.warnings.begin(), r.warnings.end(), [](const auto& warning) {
    return warning.find("is cut off") != std::string::npos;
  }));
}

}  // namespace
}  // namespace hexwall::test
