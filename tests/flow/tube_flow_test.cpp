// Cases of flow in a straight tube, run by OpenFOAM, against exact solutions.

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "exporters/openfoam_case.h"
#include "flow/read_run.h"
#include "flow/wall_shear.h"
#include "support/cell_tube.h"
#include "support/expect_error.h"
#include "support/foam_run.h"
#include "support/temporary_folder.h"
#include "support/womersley.h"

namespace hexwall {
namespace {

using std::numbers::pi;
using test::expect_error;

constexpr double millimetre = 1e-3;

struct TubeRun {
  FlowSetup setup;
  double shear = 0.0;          ///< Pa, mean in the middle half, along z
  double magnitude = 0.0;      ///< Pa, the same of the magnitude
  double tawss = 0.0;          ///< Pa, of a pulse
  double pressure_drop = 0.0;  ///< Pa, from the inlet to the outlet
};

CellTube tube_of(int across) {
  CellTube tube;
  tube.across = across;
  tube.rings = across * 3 / 4;
  tube.along = 2 * across;
  return tube;
}

/// Means over the middle half of the wall, weighted by area.
void measure_wall(const std::filesystem::path& case_dir, double length, TubeRun& run) {
  const RunWalls walls = read_run(case_dir);
  ASSERT_EQ(walls.walls.size(), 1U);
  const RunWall& wall = walls.walls.front();
  const WallShear shear = wall_shear(wall, run.setup.blood.density);
  double area = 0.0;
  for (std::size_t f = 0; f < wall.faces.size(); ++f) {
    double z = 0.0;
    for (const int corner : wall.faces[f]) z += wall.points[corner].z();
    z /= static_cast<double>(wall.faces[f].size());
    if (z < 0.25 * length || z > 0.75 * length) continue;
    area += wall.areas[f];
    run.shear += wall.areas[f] * shear.stress[f].z();
    run.magnitude += wall.areas[f] * shear.magnitude[f];
    if (!shear.tawss.empty()) run.tawss += wall.areas[f] * shear.tawss[f];
  }
  for (double* mean : {&run.shear, &run.magnitude, &run.tawss}) *mean /= area;
}

void run_tube(const CellTube& tube, const FlowOptions& options, TubeRun& run, int processes = 1) {
  const TemporaryFolder folder;
  const CellMesh mesh = cell_tube(tube);
  run.setup = set_up_flow(mesh, openings(tube), options, millimetre);
  write_openfoam_case(folder.path(), mesh, run.setup, {millimetre, processes});
  ASSERT_EQ(test::run_case(folder.path()), "");
  measure_wall(folder.path(), tube.length * millimetre, run);
  run.pressure_drop =
      run.setup.blood.density * (test::last_value(folder.path(), "pressure_inlet") -
                                 test::last_value(folder.path(), "pressure_outlet"));
  EXPECT_NEAR(test::last_value(folder.path(), "flowRate_outlet") /
                  -test::last_value(folder.path(), "flowRate_inlet"),
              1.0, 1e-6);
}

class TubeFlow : public testing::Test {
 protected:
  void SetUp() override {
    if (!test::is_installed("simpleFoam")) GTEST_SKIP() << "OpenFOAM is not installed";
  }
};

double exact_shear(const TubeRun& run) {
  const double radius = millimetre;
  return 4.0 * run.setup.blood.viscosity * run.setup.flow_rate / (pi * std::pow(radius, 3));
}

TEST_F(TubeFlow, PoiseuilleConvergesWithSecondOrder) {
  FlowOptions options;
  options.reynolds = 100.0;
  std::vector<double> shear_errors;
  std::vector<double> drop_errors;
  for (const int across : {4, 8}) {
    const CellTube tube = tube_of(across);
    TubeRun run;
    ASSERT_NO_FATAL_FAILURE(run_tube(tube, options, run));
    const double exact = exact_shear(run);
    EXPECT_GT(run.shear, 0.0);  // along the flow
    shear_errors.push_back(std::abs(run.shear / exact - 1.0));
    // Balance of forces: Δp π R² = τ 2 π R L.
    const double drop = 2.0 * exact * tube.length;
    drop_errors.push_back(std::abs(run.pressure_drop / drop - 1.0));
  }
  EXPECT_LT(shear_errors[1], 0.007);
  EXPECT_GT(std::log2(shear_errors[0] / shear_errors[1]), 1.5) << shear_errors[0];
  EXPECT_LT(drop_errors[1], 0.015);
  EXPECT_GT(std::log2(drop_errors[0] / drop_errors[1]), 1.5) << drop_errors[0];
}

/// Shear rate at which the fluid bears the stress `tau`.
double shear_rate_at(const Blood& blood, double tau) {
  double low = 0.0;
  double high = tau / blood.viscosity;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (viscosity_at(blood, middle) * middle < tau ? low : high) = middle;
  }
  return high;
}

/// Flow rate in a tube with the wall shear stress `tau`: π ∫ r² γ(τ r/R) dr.
double flow_rate_at(const Blood& blood, double radius, double tau) {
  constexpr int steps = 2000;
  double sum = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double s = (i + 0.5) / steps;
    sum += s * s * shear_rate_at(blood, tau * s);
  }
  return pi * std::pow(radius, 3) * sum / steps;
}

TEST_F(TubeFlow, CarreauFluidHasItsOwnWallShear) {
  FlowOptions options;
  options.reynolds = 30.0;
  options.blood.model = FluidModel::carreau;
  CellTube tube = tube_of(6);
  tube.length = 10.0;  // the Newtonian profile of the inlet becomes the fluid's own
  tube.along = 20;
  TubeRun run;
  ASSERT_NO_FATAL_FAILURE(run_tube(tube, options, run));
  double low = 0.0;
  double high = 10.0 * exact_shear(run);
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (flow_rate_at(run.setup.blood, millimetre, middle) < run.setup.flow_rate ? low : high) = middle;
  }
  EXPECT_GT(high, 1.2 * exact_shear(run));
  EXPECT_NEAR(run.shear / high, 1.0, 0.02);
}

TEST_F(TubeFlow, WomersleyFlowHasItsShearAndItsMean) {
  FlowOptions options;
  options.pulsatile = true;
  options.cycles = 2;
  // Q (1 + 0.6 cos ωt), with the Womersley number 4.
  const double nu = options.blood.kinematic_viscosity();
  const double omega = 16.0 * nu / (millimetre * millimetre);
  const double flow_rate = 5e-7;
  Waveform waveform;
  for (int i = 0; i <= 100; ++i) {
    waveform.times.push_back(2.0 * pi / omega * i / 100.0);
    waveform.flows.push_back(flow_rate * (1.0 + 0.6 * std::cos(2.0 * pi * i / 100.0)));
  }
  waveform.flows.back() = waveform.flows.front();
  options.waveform = waveform;
  TubeRun run;
  ASSERT_NO_FATAL_FAILURE(run_tube(tube_of(4), options, run));
  EXPECT_NEAR(run.setup.pulse->womersley, 4.0, 0.1);
  // In the circle that has the area of the meshed polygon, which is 2.5 % smaller than the tube's.
  const double radius = 0.5 * run.setup.inlet_diameter;
  const Womersley exact{radius, omega / nu};
  const double amplitude =
      0.6 * run.setup.blood.viscosity * run.setup.velocity * exact.wall_shear_rate().real();
  const double steady = 4.0 * run.setup.blood.viscosity * run.setup.velocity / radius;
  EXPECT_NEAR(run.shear / (steady + amplitude), 1.0, 0.03);
  EXPECT_NEAR(run.tawss / steady, 1.0, 0.03);
  EXPECT_GT(run.shear, 1.4 * run.tawss);
}

TEST_F(TubeFlow, ParallelRunHasTheResultOfOneProcess) {
  if (!test::is_installed("mpirun")) GTEST_SKIP() << "Open MPI is not installed";
  FlowOptions options;
  options.reynolds = 100.0;
  TubeRun serial;
  TubeRun parallel;
  ASSERT_NO_FATAL_FAILURE(run_tube(tube_of(4), options, serial));
  ::setenv("MPIRUN_OPTIONS", "--oversubscribe", 1);
  ASSERT_NO_FATAL_FAILURE(run_tube(tube_of(4), options, parallel, 2));
  EXPECT_NEAR(parallel.shear / serial.shear, 1.0, 1e-4);
}

TEST(ReadRun, SaysWhatIsMissing) {
  const TemporaryFolder folder;
  expect_error(ExitCode::read, {"no OpenFOAM case"}, [&] { read_run(folder / "nothing"); });
  const CellMesh mesh = cell_tube({});
  write_openfoam_case(folder.path(), mesh, set_up_flow(mesh, openings(CellTube{}), {}, millimetre),
                      {millimetre, 1});
  expect_error(ExitCode::read, {"no results", "Allrun"}, [&] { read_run(folder.path()); });
  std::filesystem::create_directories(folder / "processor0");
  expect_error(ExitCode::read, {"reconstructPar"}, [&] { read_run(folder.path()); });
  std::filesystem::create_directories(folder / "7");
  std::filesystem::copy(folder / "0/p", folder / "7/p");
  expect_error(ExitCode::read, {"no wallShearStress", "time 7"}, [&] { read_run(folder.path()); });
}

}  // namespace
}  // namespace hexwall
