// What is made of wall shear stress: means over time and over area.

#include "flow/wall_shear.h"

#include <gtest/gtest.h>

namespace hexwall {
namespace {

RunWall wall_with(const Vec3& mean, double mean_magnitude) {
  RunWall wall;
  wall.faces = {{0, 1, 2}};
  wall.areas = {1.0};
  wall.shear = {Vec3(0.0, -3e-3, 4e-3)};
  wall.mean_shear = {mean};
  wall.mean_magnitude = {mean_magnitude};
  return wall;
}

TEST(WallShear, IsInPascalAndAlongTheFlow) {
  const WallShear shear = wall_shear(wall_with(Vec3::Zero(), 0.0), 1000.0);
  EXPECT_NEAR((shear.stress[0] - Vec3(0.0, 3.0, -4.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR(shear.magnitude[0], 5.0, 1e-12);
}

TEST(WallShear, SteadyDirectionDoesNotOscillate) {
  const WallShear shear = wall_shear(wall_with(Vec3(0.0, 0.0, -2e-3), 2e-3), 1000.0);
  EXPECT_NEAR(shear.tawss[0], 2.0, 1e-12);
  EXPECT_NEAR(shear.osi[0], 0.0, 1e-12);
  EXPECT_NEAR(shear.rrt[0], 0.5, 1e-12);
}

TEST(WallShear, OscillationIsHalfWithoutAMeanDirection) {
  const WallShear shear = wall_shear(wall_with(Vec3::Zero(), 2e-3), 1000.0);
  EXPECT_DOUBLE_EQ(shear.osi[0], 0.5);
  EXPECT_NEAR(shear.rrt[0], 1.0 / (2e-4 * 2.0), 1e-6);
  // Three quarters forward, one quarter back.
  EXPECT_NEAR(wall_shear(wall_with(Vec3(1e-3, 0.0, 0.0), 2e-3), 1000.0).osi[0], 0.25, 1e-12);
}

TEST(WallShear, NoStressIsNoDivisionByZero) {
  const WallShear shear = wall_shear(wall_with(Vec3::Zero(), 0.0), 1000.0);
  EXPECT_EQ(shear.osi[0], 0.0);
  EXPECT_NEAR(shear.rrt[0], 1e6, 1.0);
}

TEST(WallShear, WithoutMeansThereIsNoPulse) {
  RunWall wall = wall_with(Vec3::Zero(), 0.0);
  wall.mean_shear.clear();
  const WallShear shear = wall_shear(wall, 1000.0);
  EXPECT_EQ(shear.magnitude.size(), 1U);
  EXPECT_TRUE(shear.tawss.empty());
  EXPECT_TRUE(shear.osi.empty());
  EXPECT_TRUE(shear.rrt.empty());
}

TEST(AreaStatistics, AreWeightedByArea) {
  const AreaStatistics s = area_statistics({3.0, 1.0, 2.0}, {1.0, 7.0, 2.0});
  EXPECT_DOUBLE_EQ(s.mean, 1.4);
  EXPECT_EQ(s.least, 1.0);
  EXPECT_EQ(s.greatest, 3.0);
  // Of the area 70 % has the value 1, the next 20 % have 2.
  EXPECT_EQ(s.percentiles, (std::vector<double>{1.0, 1.0, 1.0, 1.0, 2.0, 3.0, 3.0}));
  EXPECT_DOUBLE_EQ(area_fraction_below({3.0, 1.0, 2.0}, {1.0, 7.0, 2.0}, 2.0), 0.7);
}

}  // namespace
}  // namespace hexwall
