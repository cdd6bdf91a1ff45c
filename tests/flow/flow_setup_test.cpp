// Boundary values of a flow: Reynolds number, shares of the outlets, pulse.

#include "flow/flow_setup.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "support/cell_tube.h"
#include "support/expect_error.h"

namespace hexwall {
namespace {

using std::numbers::pi;
using test::expect_error;

constexpr double millimetre = 1e-3;

/// A tube whose outlet is said to be three: shares depend on the openings' areas alone.
struct Tube {
  CellMesh mesh;
  std::vector<LumenOpening> openings;
};

Tube tube_with_three_outlets() {
  Tube tube{cell_tube({}), openings(CellTube{})};
  LumenOpening outlet = tube.openings.back();
  tube.openings.pop_back();
  for (const double radius : {1.0, 2.0, 1.5}) {
    outlet.patch = "outlet_" + std::to_string(tube.openings.size());
    outlet.radius = radius;
    outlet.area = pi * radius * radius;
    tube.openings.push_back(outlet);
  }
  return tube;
}

FlowSetup set_up(const FlowOptions& options) {
  return set_up_flow(cell_tube({}), openings(CellTube{}), options, millimetre);
}

double flow_rate(const std::vector<Vec3>& velocities) {
  const CellDisc disc = cross_section({});
  double sum = 0.0;
  for (std::size_t f = 0; f < velocities.size(); ++f) {
    const auto& v = disc.faces[f].vertices;
    const Vec3 area =
        0.5 * (disc.points[v[2]] - disc.points[v[0]]).cross(disc.points[v[3]] - disc.points[v[1]]);
    sum -= area.dot(velocities[f]) * millimetre * millimetre;
  }
  return sum;
}

TEST(FlowSetup, ReynoldsNumberGivesTheFlowRate) {
  FlowOptions options;
  options.reynolds = 250.0;
  const FlowSetup setup = set_up(options);
  EXPECT_NEAR(setup.reynolds, 250.0, 1e-10);
  EXPECT_NEAR(setup.velocity * setup.inlet_diameter / options.blood.kinematic_viscosity(), 250.0,
              1e-10);
  EXPECT_NEAR(setup.inlet_diameter, 2.0 * std::sqrt(setup.inlet_area / pi), 1e-15);
  EXPECT_NEAR(flow_rate(setup.inlet_velocities) / setup.flow_rate, 1.0, 1e-12);
  for (const Vec3& u : setup.inlet_velocities) EXPECT_GT(u.z(), 0.0);
}

TEST(FlowSetup, FlowRateGivesTheReynoldsNumber) {
  FlowOptions options;
  options.flow_rate = 4e-6;
  const FlowSetup setup = set_up(options);
  EXPECT_DOUBLE_EQ(setup.flow_rate, 4e-6);
  EXPECT_NEAR(setup.reynolds,
              4.0 * 4e-6 / (pi * setup.inlet_diameter * options.blood.kinematic_viscosity()), 1e-9);
  EXPECT_NEAR(set_up({}).reynolds, 300.0, 1e-10);
}

TEST(FlowSetup, SharesFollowMurraysLaw) {
  const Tube tube = tube_with_three_outlets();
  const FlowSetup setup = set_up_flow(tube.mesh, tube.openings, {}, millimetre);
  ASSERT_EQ(setup.outlets.size(), 3U);
  const double sum = 1.0 + 8.0 + 3.375;
  EXPECT_NEAR(setup.outlets[0].share, 1.0 / sum, 1e-14);
  EXPECT_NEAR(setup.outlets[1].share, 8.0 / sum, 1e-14);
  EXPECT_NEAR(setup.outlets[2].share, 3.375 / sum, 1e-14);
  EXPECT_NEAR(setup.outlets[1].radius, 2e-3, 1e-15);
  EXPECT_FALSE(setup.outlets[0].fixes_pressure);
  EXPECT_TRUE(setup.outlets[1].fixes_pressure);
  EXPECT_FALSE(setup.outlets[2].fixes_pressure);
}

TEST(FlowSetup, GivenSharesAreScaledToOne) {
  const Tube tube = tube_with_three_outlets();
  FlowOptions options;
  options.split = {{"outlet_1", 6.0}, {"outlet_2", 3.0}, {"outlet_3", 1.0}};
  const FlowSetup setup = set_up_flow(tube.mesh, tube.openings, options, millimetre);
  EXPECT_NEAR(setup.outlets[0].share, 0.6, 1e-14);
  EXPECT_TRUE(setup.outlets[0].fixes_pressure);
  EXPECT_NEAR(setup.outlets[2].share, 0.1, 1e-14);
}

TEST(FlowSetup, PulseHasTheFlowOfItsWaveformOnTheFaces) {
  FlowOptions options;
  options.pulsatile = true;
  options.reynolds = 100.0;
  options.period = 0.9;
  const FlowSetup setup = set_up(options);
  ASSERT_TRUE(setup.pulse.has_value());
  const Pulse& pulse = *setup.pulse;
  ASSERT_EQ(pulse.times.size(), pulse.velocities.size());
  EXPECT_DOUBLE_EQ(pulse.times.back(), 0.9);
  double sum = 0.0;
  for (std::size_t i = 0; i < pulse.times.size(); ++i) {
    EXPECT_NEAR(flow_rate(pulse.velocities[i]) / pulse.flows[i], 1.0, 1e-10);
    if (i > 0) sum += pulse.flows[i];
  }
  EXPECT_NEAR(sum / 100.0 / setup.flow_rate, 1.0, 1e-10);
  EXPECT_EQ(pulse.velocities.front(), pulse.velocities.back());
  EXPECT_NEAR(pulse.womersley,
              0.5 * setup.inlet_diameter *
                  std::sqrt(2.0 * pi / (0.9 * options.blood.kinematic_viscosity())),
              1e-12);
  EXPECT_NEAR(pulse.peak_reynolds, 176.0, 3.0);
}

TEST(FlowSetup, WaveformOfAFileGivesTheFlowRateUnlessItIsGiven) {
  FlowOptions options;
  options.pulsatile = true;
  options.waveform = Waveform{{0.0, 0.2, 0.6}, {1e-6, 3e-6, 1e-6}};
  EXPECT_NEAR(set_up(options).flow_rate, 2e-6, 1e-18);
  EXPECT_DOUBLE_EQ(set_up(options).pulse->period, 0.6);
  options.flow_rate = 5e-6;
  EXPECT_NEAR(set_up(options).flow_rate, 5e-6, 1e-18);
}

TEST(FlowSetup, WarnsOfTurbulenceAndOfEdgesInTheWaveform) {
  FlowOptions options;
  options.reynolds = 2500.0;
  EXPECT_EQ(set_up(options).warnings.size(), 1U);
  options = {};
  EXPECT_TRUE(set_up(options).warnings.empty());
  options.pulsatile = true;
  options.waveform = Waveform{{0.0, 0.499, 0.5, 0.999, 1.0}, {1e-6, 1e-6, 2e-6, 2e-6, 1e-6}};
  EXPECT_EQ(set_up(options).warnings.size(), 1U);
  options.waveform.reset();
  options.blood.model = FluidModel::carreau;
  EXPECT_EQ(set_up(options).warnings.size(), 1U);
}

TEST(FlowSetup, RefusesOptionsOutOfRange) {
  const auto refused = [](FlowOptions options, const char* word) {
    expect_error(ExitCode::usage, {word}, [&] { set_up(options); });
  };
  FlowOptions options;
  options.reynolds = 0.0;
  refused(options, "--re");
  options.reynolds = 100.0;
  options.flow_rate = 1.0;
  refused(options, "exclude");
  options = {};
  options.flow_rate = std::numeric_limits<double>::quiet_NaN();
  refused(options, "--flow-rate");
  options = {};
  options.split = {{"elsewhere", 1.0}};
  refused(options, "the outlets are outlet");
  options.split = {{"outlet", -1.0}};
  refused(options, "positive");
  options = {};
  options.blood.density = -1.0;
  refused(options, "--density");
  options = {};
  options.blood.model = FluidModel::carreau;
  options.blood.viscosity = 0.1;
  refused(options, "at rest");
  options = {};
  options.pulsatile = true;
  options.cycles = 0;
  refused(options, "--cycles");
  options.cycles = 3;
  options.period = 0.0;
  refused(options, "--period");
}

TEST(FlowSetup, RefusesOtherThanOneInletAndAllOutlets) {
  Tube tube = tube_with_three_outlets();
  FlowOptions options;
  options.split = {{"outlet_1", 6.0}};
  expect_error(ExitCode::usage, {"all outlets", "outlet_1, outlet_2, outlet_3"},
               [&] { set_up_flow(tube.mesh, tube.openings, options, millimetre); });
  tube.openings[0].inlet = false;
  expect_error(ExitCode::usage, {"0 of the 4"},
               [&] { set_up_flow(tube.mesh, tube.openings, {}, millimetre); });
  tube.openings[0].inlet = true;
  tube.openings.resize(1);
  expect_error(ExitCode::usage, {"at least one outlet"},
               [&] { set_up_flow(tube.mesh, tube.openings, {}, millimetre); });
}

TEST(Blood, CarreauThinsFromRestToTheNewtonianLimit) {
  Blood blood;
  EXPECT_EQ(viscosity_at(blood, 3.0), blood.viscosity);
  blood.model = FluidModel::carreau;
  EXPECT_DOUBLE_EQ(viscosity_at(blood, 0.0), blood.viscosity_at_rest);
  EXPECT_NEAR(viscosity_at(blood, 1e9), blood.viscosity, 1e-6);
  // (1 + 1)^((n-1)/2) of the way from infinity to rest, at the shear rate 1/λ.
  EXPECT_NEAR(viscosity_at(blood, 1.0 / 3.313), 3.45e-3 + 52.55e-3 * std::pow(2.0, -0.3216), 1e-15);
}

}  // namespace
}  // namespace hexwall
