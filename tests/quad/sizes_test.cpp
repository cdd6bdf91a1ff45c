// Target sizes: quads are as large as asked for, everywhere alike or where a field says otherwise.

#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "pipeline.h"
#include "support/expect_error.h"
#include "support/surfaces.h"
#include "support/verify_wall.h"
#include "surface/generate.h"
#include "warnings.h"

namespace hexwall::test {
namespace {

PipelineOptions options_of(double size) {
  PipelineOptions options;
  options.size = size;
  options.relax = 1.0;
  return options;
}

// Mean quad edge over the target within a slab of the z axis.
double mean_edge(const PipelineResult& r, double z_low, double z_high) {
  double sum = 0.0;
  int count = 0;
  for (const auto& [a, b] : edges_of(r.quads)) {
    const Vec3 middle = 0.5 * (r.quads.points[a] + r.quads.points[b]);
    if (middle.z() < z_low || middle.z() > z_high) continue;
    sum += (r.quads.points[a] - r.quads.points[b]).norm();
    ++count;
  }
  return sum / count;
}

TEST(SizeField, OfOneValueIsASize) {
  const TriangleSurface surface = generate_shape(Shape::bifurcation, 0.25);
  PipelineOptions options = options_of(0.15);
  options.size_field.assign(surface.points.size(), 2.0);
  const PipelineResult twice = run_pipeline(surface, options);
  const PipelineResult plain = run_pipeline(surface, options_of(0.3));
  ASSERT_EQ(twice.quads.quads, plain.quads.quads);
  for (std::size_t v = 0; v < plain.quads.points.size(); ++v) {
    EXPECT_LT((twice.quads.points[v] - plain.quads.points[v]).norm(), 1e-6);
  }
  EXPECT_NEAR(twice.solution.optimum.energy, plain.solution.optimum.energy, 1e-9);
}

// A tube with a narrow half can have a ring of the same number of quads only: a field that asks for
// smaller quads in the narrow half is met, and lowers the distortion.
TEST(SizeField, IsFollowedAlongAVessel) {
  TriangleSurface surface = cylinder(2.0, 20.0, 48, 100);
  PipelineOptions options = options_of(0.4);
  for (Vec3& p : surface.points) {
    const double wanted = 0.75 + 0.25 * std::tanh(0.5 * (p.z() - 10.0));
    p = Vec3(wanted * p.x(), wanted * p.y(), p.z());
    options.size_field.push_back(wanted);
  }
  const PipelineResult r = run_pipeline(surface, options);
  EXPECT_NEAR(mean_edge(r, 1.0, 6.0), 0.5 * 0.4, 0.03);
  EXPECT_NEAR(mean_edge(r, 14.0, 19.0), 0.4, 0.03);
  EXPECT_LT(r.solution.optimum.energy, 0.02);
  EXPECT_GT(run_pipeline(surface, options_of(0.4)).solution.optimum.energy, 0.1);
  EXPECT_NEAR(r.quad_quality.edge_length_quantiles[2], 1.0, 0.1);
  EXPECT_EQ(r.quad_quality.off_size_area_fraction, 0.0);
}

TEST(SizeByRadius, GivesBranchesAndTrunksAsManyQuadsAround) {
  const TriangleSurface surface = generate_shape(Shape::aaa);
  PipelineOptions options = options_of(1.5);
  options.size_by_radius = true;
  const PipelineResult by_radius = run_pipeline(surface, options);
  const PipelineResult even = run_pipeline(surface, options_of(1.5));
  // Quads around the trunk's opening, the longest, over those around the middle one of the others.
  const auto ratio = [](const PipelineResult& r) {
    std::vector<double> around;
    for (int loop = 0; loop < static_cast<int>(r.openings.size()); ++loop) {
      around.push_back(static_cast<double>(
          std::count(r.quads.loop_of_vertex.begin(), r.quads.loop_of_vertex.end(), loop)));
    }
    const auto middle = around.begin() + static_cast<std::ptrdiff_t>(around.size()) / 2;
    std::nth_element(around.begin() + 1, middle, around.end());
    return around[0] / *middle;
  };
  EXPECT_GT(ratio(even), 1.5 * ratio(by_radius));
  EXPECT_LT(by_radius.solution.optimum.energy, even.solution.optimum.energy);
  EXPECT_LT(by_radius.quad_quality.off_size_area_fraction, 0.05);
}

/// Lengths of the edges along and around a cylinder of radius 2 along z.
std::array<double, 2> lengths_along_and_around(const PipelineResult& r) {
  std::array<double, 2> sum{};
  std::array<int, 2> count{};
  for (const auto& [a, b] : edges_of(r.quads)) {
    const Vec3 edge = r.quads.points[a] - r.quads.points[b];
    const int i = std::abs(edge.z()) > 0.5 * edge.norm() ? 0 : 1;
    sum[i] += edge.norm();
    ++count[i];
  }
  return {sum[0] / count[0], sum[1] / count[1]};
}

class Stretch : public testing::TestWithParam<double> {};

TEST_P(Stretch, IsTheLengthOfQuadsAlongOverTheirWidthAround) {
  PipelineOptions options = options_of(0.4);
  options.stretch = GetParam();
  const PipelineResult r = run_pipeline(cylinder(2.0, 20.0, 48, 100), options);
  const auto [along, around] = lengths_along_and_around(r);
  EXPECT_NEAR(around, 0.4, 0.01);
  EXPECT_NEAR(along, 0.4 * GetParam(), 0.02 * GetParam());
  EXPECT_EQ(r.quad_quality.off_size_area_fraction, 0.0);
  EXPECT_GT(r.min_wall_scaled_jacobian, 0.95);
}

INSTANTIATE_TEST_SUITE_P(, Stretch, testing::Values(0.5, 1.0, 2.0, 4.0));

TEST(StretchedQuads, OfABifurcationGivesFewerQuadsAndTheSameSingularities) {
  const TriangleSurface surface = generate_shape(Shape::bifurcation, 0.15);
  PipelineOptions options = options_of(0.2);
  const PipelineResult square = run_pipeline(surface, options);
  options.stretch = 2.0;
  const PipelineResult stretched = run_pipeline(surface, options);
  expect_valid_wall(stretched);
  EXPECT_EQ(stretched.numbers.across, square.numbers.across);
  EXPECT_EQ(stretched.quad_quality.irregular, square.quad_quality.irregular);
  EXPECT_NEAR(static_cast<double>(stretched.quads.quads.size()),
              0.5 * static_cast<double>(square.quads.quads.size()),
              0.05 * static_cast<double>(square.quads.quads.size()));
}

TEST(StretchedQuads, MustBeWithinReason) {
  PipelineOptions options = options_of(0.3);
  for (const double stretch : {0.0, -1.0, 11.0, std::nan("")}) {
    options.stretch = stretch;
    expect_error(ExitCode::usage, {"--stretch"},
                 [&] { run_pipeline(cylinder(1.0, 4.0, 24, 16), options); });
  }
}

TEST(SizeField, MustBePositiveAndComplete) {
  const TriangleSurface surface = cylinder(1.0, 4.0, 24, 16);
  PipelineOptions options = options_of(0.3);
  options.size_field.assign(surface.points.size(), 1.0);
  options.size_field[7] = 0.0;
  expect_error(ExitCode::usage, {"the size field is 0 at ("},
               [&] { run_pipeline(surface, options); });
  options.size_field.resize(5);
  expect_error(ExitCode::usage, {"one value for each vertex"},
               [&] { run_pipeline(surface, options); });
}

// With 20,000 quads there would be 7 around this tube.
TEST(Size, ByDefaultIsNotTooLargeForThinVessels) {
  const TriangleSurface surface = cylinder(1.0, 2400.0, 12, 4000);
  const PipelineResult r = run_pipeline(surface, {});
  for (int loop = 0; loop < 2; ++loop) {
    EXPECT_EQ(std::count(r.quads.loop_of_vertex.begin(), r.quads.loop_of_vertex.end(), loop), 9);
  }
}

TEST(Size, IsSaidToBeTooLargeWhereQuadsAreBad) {
  PipelineResult r = run_pipeline(cylinder(1.0, 4.0, 24, 20), {});
  const auto says_so = [](const std::string& warning) {
    return warning.find("3 quads are badly shaped") != std::string::npos &&
           warning.find("worst of 0.1 at") != std::string::npos;
  };
  EXPECT_EQ(std::count_if(r.warnings.begin(), r.warnings.end(), says_so), 0);
  // No surface at hand has such quads: relaxation does not let them come.
  r.quad_quality.scaled_jacobian[7] = 0.1;
  r.quad_quality.scaled_jacobian[9] = r.quad_quality.scaled_jacobian[11] = 0.15;
  r.warnings.clear();
  add_warnings(r);
  EXPECT_EQ(std::count_if(r.warnings.begin(), r.warnings.end(), says_so), 1);
}

}  // namespace
}  // namespace hexwall::test
