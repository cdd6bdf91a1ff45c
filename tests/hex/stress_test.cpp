// Walls and near-wall layers where there is little room for them: whatever is asked, no hex is
// inverted, nothing meets itself, no layer is missing, and what had to be reduced is told.

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <ostream>

#include <Eigen/Geometry>
#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>

#include "pipeline.h"
#include "support/surfaces.h"
#include "support/verify_wall.h"
#include "support/vessel_surfaces.h"
#include "surface/generate.h"
#include "surface/vessel_tree.h"

namespace hexwall::test {
namespace {

using std::numbers::pi;

Branch tube_along(std::vector<Vec3> line, double radius) {
  std::vector<double> radii(line.size(), radius);
  return {std::move(line), std::move(radii), true, true, 0.0};
}

/// A Y whose branches meet in a crotch with a fillet of the radius `fillet`.
TriangleSurface sharp_crotch(double fillet) {
  std::vector<Branch> branches{
      {{{0, 0, -6}, {0, 0, 0}, {2.2, 0, 6}}, {1.0, 1.0, 0.8}, true, true, 0.0},
      {{{0, 0, -0.5}, {-0.6, 0, 1.2}, {-2.2, 0, 6}}, {0.8, 0.8, 0.8}, false, true, fillet}};
  return vessel_tree(branches, 0.2);
}

/// A tube of radius 1 swept along a curve (t from 0 to 1) with a frame that keeps `side` across it.
TriangleSurface swept(const std::function<Vec3(double)>& curve, const Vec3& side, int around,
                      int along) {
  return transformed(cylinder(1.0, 1.0, around, along), [&](const Vec3& p) -> Vec3 {
    const double h = 1e-4;
    const Vec3 tangent = (curve(p.z() + h) - curve(p.z() - h)).normalized();
    const Vec3 u = side.cross(tangent).normalized();
    return curve(p.z()) + p.x() * u + p.y() * tangent.cross(u);
  });
}

/// Two parallel limbs of radius 1, `gap` apart, joined by a wide bend.
TriangleSurface hairpin(double gap) {
  const double narrow = 1.0 + 0.5 * gap;
  const double wide = 2.5;
  const auto curve = [=](double t) -> Vec3 {
    const double length = 10.0 + 0.5 * pi * wide;  // of a half
    const double s = length * (1.0 - std::abs(2.0 * t - 1.0));
    const double sign = t < 0.5 ? 1.0 : -1.0;
    if (s > 10.0) {
      const double angle = (s - 10.0) / wide;
      return {sign * wide * std::cos(angle), 0.0, wide * std::sin(angle)};
    }
    const double x = std::clamp((s - 4.0) / 6.0, 0.0, 1.0);
    return {sign * (narrow + (wide - narrow) * x * x * (3.0 - 2.0 * x)), 0.0, s - 10.0};
  };
  return swept(curve, Vec3::UnitY(), 32, 140);
}

/// A vessel curled up like a spring of two turns, `gap` apart.
TriangleSurface curled(double gap) {
  const double pitch = 2.0 + gap;
  const auto curve = [=](double t) -> Vec3 {
    const double angle = 4.0 * pi * t;
    return {3.0 * std::cos(angle), 3.0 * std::sin(angle), pitch * angle / (2.0 * pi)};
  };
  return swept(curve, Vec3::UnitZ(), 32, 200);
}

/// A tube narrowed to a fifth of its radius.
TriangleSurface stenosis() {
  return vessel_tree({{{{0, 0, 0}, {0, 0, 3}, {0, 0, 5}, {0, 0, 7}, {0, 0, 10}},
                       {1.0, 1.0, 0.2, 1.0, 1.0},
                       true,
                       true,
                       0.0}},
                     0.12);
}

/// A ball of radius 2 on a short narrow neck beside a tube.
TriangleSurface sac_on_a_neck() {
  return vessel_tree({tube_along({{0, 0, -6}, {0, 0, 0}, {0, 0, 6}}, 1.0),
                      {{{0, 0, 0}, {1.8, 0, 0}}, {0.6, 0.6}, false, false, 0.2},
                      {{{3.2, 0, 0}, {3.4, 0, 0}}, {2.0, 2.0}, false, false, 0.2}},
                     0.22);
}

/// Whether the layers fit as thick as they are asked.
enum class Room {
  enough,  ///< nothing may be reduced
  none,    ///< something has to be
  unknown
};

struct Stress {
  const char* name;
  std::function<TriangleSurface()> surface;
  double thickness;
  const char* side;  ///< out, in or both
  Room room = Room::none;
};

void PrintTo(const Stress& stress, std::ostream* out) {
  *out << stress.name << ' ' << stress.thickness << ' ' << stress.side;
}

class Stressed : public testing::TestWithParam<Stress> {};

TEST_P(Stressed, IsValidEverywhere) {
  const Stress& stress = GetParam();
  const std::string side = stress.side;
  PipelineOptions options;
  LayerOptions layers;
  layers.thickness = stress.thickness;
  layers.layers = 2;
  options.outward.reset();
  if (side != "in") options.outward = layers;
  if (side != "out") options.inward = layers;
  options.size = 0.3;
  const PipelineResult r = run_pipeline(stress.surface(), options);
  expect_valid_wall(r);
  expect_no_self_intersection(r.wall);
  const auto is_reduced = [](const std::optional<ThicknessResult>& one) {
    return one && one->reduced_area_fraction > 0.0;
  };
  if (stress.room == Room::unknown) return;
  EXPECT_EQ(is_reduced(r.outward) || is_reduced(r.inward), stress.room == Room::none);
}

std::vector<Stress> stresses() {
  std::vector<Stress> all;
  for (const double times : {0.5, 1.0, 2.0}) {
    all.push_back({"crotch", [] { return sharp_crotch(0.3); }, 0.3 * times, "out",
                   times < 1.5 ? Room::enough : Room::none});
  }
  for (const double gaps : {0.1, 0.5, 1.0, 1.9, 3.0}) {
    const double thickness = 0.5;
    all.push_back({"hairpin", [=] { return hairpin(gaps * thickness); }, thickness, "out",
                   gaps > 2.2 ? Room::enough : Room::none});
  }
  all.push_back({"curled", [] { return curled(0.1); }, 0.3, "out"});
  all.push_back({"curled", [] { return curled(0.1); }, 0.3, "both"});
  all.push_back({"curled", [] { return curled(1.0); }, 0.3, "both", Room::enough});
  all.push_back({"stenosis", stenosis, 0.15, "in", Room::enough});
  all.push_back({"stenosis", stenosis, 0.4, "in"});
  all.push_back({"stenosis", stenosis, 0.4, "both"});
  all.push_back({"sac", sac_on_a_neck, 0.4, "out", Room::unknown});
  all.push_back({"sac", sac_on_a_neck, 0.4, "both", Room::unknown});
  all.push_back({"tree47", [] { return tree_with_sides(45); }, 0.15, "both", Room::enough});
  all.push_back({"tree47", [] { return tree_with_sides(45); }, 0.5, "out"});
  return all;
}

INSTANTIATE_TEST_SUITE_P(, Stressed, testing::ValuesIn(stresses()), [](const auto& test) {
  return std::string(test.param.name) + "_" + test.param.side + "_" + std::to_string(test.index);
});

/// A thickness that is reduced where limbs nearly touch leaves them apart, and each gets its half.
TEST(Hairpin, SharesTheGapEvenly) {
  PipelineOptions options;
  options.outward->thickness = 0.5;
  options.size = 0.3;
  const PipelineResult r = run_pipeline(hairpin(0.4), options);
  const ThicknessResult& side = *r.outward;
  EXPECT_GT(side.colliding_quads, 0);
  const double least = *std::min_element(side.given.begin(), side.given.end());
  EXPECT_LT(least, 0.2);
  EXPECT_GT(least, 0.1);
  EXPECT_LT(side.reduced_area_fraction, 0.5);
}

TEST(Strict, RefusesAndSaysWhere) {
  PipelineOptions options;
  options.outward->thickness = 0.5;
  options.size = 0.3;
  options.thickness_strict = true;
  try {
    run_pipeline(hairpin(0.4), options);
    FAIL() << "nothing was thrown";
  } catch (const MeshingError& error) {
    EXPECT_NE(std::string(error.what()).find("--thickness-strict"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("instead of 0.5"), std::string::npos);
  }
  options.outward->thickness = 0.15;
  EXPECT_EQ(run_pipeline(hairpin(0.4), options).outward->reduced_area_fraction, 0.0);
}

/// The checker itself: two limbs whose walls pass through each other are found.
TEST(ExpectNoSelfIntersection, FindsWallsThatMeet) {
  PipelineOptions options;
  options.outward->thickness = 0.15;
  options.size = 0.3;
  PipelineResult r = run_pipeline(hairpin(0.4), options);
  const auto vertices = r.quads.points.size();
  for (std::size_t v = 0; v < vertices; ++v) {
    Vec3& top = r.wall.points[3 * vertices + v];
    top += 1.5 * (top - r.quads.points[v]);
  }
  testing::TestPartResultArray failures;
  {
    testing::ScopedFakeTestPartResultReporter reporter(
        testing::ScopedFakeTestPartResultReporter::INTERCEPT_ONLY_CURRENT_THREAD, &failures);
    expect_no_self_intersection(r.wall);
  }
  EXPECT_GT(failures.size(), 0);
}

}  // namespace
}  // namespace hexwall::test
