#include "hex/layers.h"

#include <gtest/gtest.h>

#include "support/expect_error.h"

namespace hexwall::test {
namespace {

void expect_levels(const LayerPlan& plan, const std::vector<double>& expected) {
  ASSERT_EQ(plan.levels.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(plan.levels[i], expected[i], 1e-15);
}

TEST(PlanLayers, GrowAwayFromTheSurfaceOnBothSides) {
  const LayerPlan plan = plan_layers(graded_layers(2, 3.0, "o"), graded_layers(3, 2.0, "i"));
  expect_levels(plan, {-1.0, -3.0 / 7.0, -1.0 / 7.0, 0.0, 0.25, 1.0});
  EXPECT_EQ(plan.zone_names, (std::vector<std::string>{"i3", "i2", "i1", "o1", "o2"}));
  EXPECT_EQ(plan.zone, (std::vector<int>{0, 1, 2, 3, 4}));
  EXPECT_EQ(plan.inner, 3);
  EXPECT_TRUE(plan.has_outer());
  EXPECT_EQ(plan.inner_levels().back(), 0.0);
  EXPECT_EQ(plan.outer_levels().front(), 0.0);
}

TEST(PlanLayers, DivideNamedGroupsEvenly) {
  const auto groups = parse_layers("intima:0.15:1,media:0.55:2,adventitia:0.3:3");
  expect_levels(plan_layers(groups, {}), {0.0, 0.15, 0.425, 0.7, 0.8, 0.9, 1.0});
  const LayerPlan inward = plan_layers({}, groups);
  expect_levels(inward, {-1.0, -0.9, -0.8, -0.7, -0.425, -0.15, 0.0});
  EXPECT_EQ(inward.zone, (std::vector<int>{0, 0, 0, 1, 1, 2}));
  EXPECT_EQ(inward.zone_names, (std::vector<std::string>{"adventitia", "media", "intima"}));
  EXPECT_FALSE(inward.has_outer());
}

TEST(PlanLayers, SharesAreRelative) {
  expect_levels(plan_layers(parse_layers("a:1:1,b:3:1"), {}), {0.0, 0.25, 1.0});
}

struct BadSpec {
  const char* text;
  const char* words;
};

class BadLayerSpec : public testing::TestWithParam<BadSpec> {};

TEST_P(BadLayerSpec, IsRefusedWithThePart) {
  expect_error(ExitCode::usage, {"--layer-spec", GetParam().words},
               [] { parse_layers(GetParam().text); });
}

INSTANTIATE_TEST_SUITE_P(, BadLayerSpec,
                         testing::Values(BadSpec{"", "empty"}, BadSpec{"media", "'media'"},
                                         BadSpec{"a:1:1,media:0.5", "'media:0.5'"},
                                         BadSpec{"a:x:1", "'a:x:1'"}, BadSpec{"a:1:2.5", "2.5"},
                                         BadSpec{"a:0:1", "positive"}, BadSpec{"a:1:0", "positive"},
                                         BadSpec{"a:nan:1", "positive"},
                                         BadSpec{"a:inf:1", "positive"},
                                         BadSpec{"a b:1:1", "'a b'"}, BadSpec{"wall:1:1", "'wall'"},
                                         BadSpec{"a:1:1,a:2:1", "twice"}));

}  // namespace
}  // namespace hexwall::test
