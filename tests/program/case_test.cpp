// `hexwall case` and `hexwall shear`: a bifurcation from its surface to its wall shear stress.

#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/child_process.h"
#include "support/foam_run.h"
#include "support/temporary_folder.h"

namespace hexwall {
namespace {

namespace fs = std::filesystem;
using test::run_hexwall;

std::string surface_in(const TemporaryFolder& folder) {
  std::string path = (folder / "bifurcation.stl").string();
  EXPECT_EQ(run_hexwall({"generate", "bifurcation", "-o", path}).exit_code, 0);
  return path;
}

nlohmann::json json_in(const fs::path& path) {
  std::ifstream file(path);
  return nlohmann::json::parse(file);
}

TEST(CaseCommand, FlowInABifurcationIsConserved) {
  if (!test::is_installed("simpleFoam")) GTEST_SKIP() << "OpenFOAM is not installed";
  const TemporaryFolder folder;
  const std::string run = (folder / "run").string();
  const auto made =
      run_hexwall({"case", surface_in(folder), "-o", run, "--size", "0.5", "--core-growth", "0.5",
                   "--re", "50", "--split", "loop_1=3,loop_2=1", "-q"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  ASSERT_EQ(test::run_case(run), "");
  const nlohmann::json flow = json_in(folder / "run/report.json").at("flow");
  const double inflow = -test::last_value(run, "flowRate_loop_0");
  EXPECT_NEAR(inflow / flow.at("flow_rate").get<double>(), 1.0, 1e-6);
  EXPECT_NEAR(test::last_value(run, "flowRate_loop_1") / inflow, 0.75, 1e-5);
  EXPECT_NEAR(test::last_value(run, "flowRate_loop_2") / inflow, 0.25, 1e-5);

  const auto shear = run_hexwall({"shear", run, "-o", (folder / "shear").string()});
  ASSERT_EQ(shear.exit_code, 0) << shear.err;
  EXPECT_NE(shear.out.find("wss"), std::string::npos);
  EXPECT_TRUE(fs::exists(folder / "shear/wall.vtp"));
  const nlohmann::json wall = json_in(folder / "shear/shear.json").at("walls").at(0);
  EXPECT_EQ(wall.at("patch"), "wall");
  // The order of the stress of developed flow in the trunk.
  const double radius = 0.5 * flow.at("inlet").at("diameter").get<double>();
  const double developed = 4.0 * 3.45e-3 * flow.at("velocity").get<double>() / radius;
  EXPECT_GT(wall.at("wss").at("p50").get<double>(), 0.3 * developed);
  EXPECT_LT(wall.at("wss").at("p50").get<double>(), 1.5 * developed);
}

// Developed flow in a straight tube, against 4 mu Q / (pi R^3) with the R of the meshed inlet.
TEST(CaseCommand, StressIsThatOfATubeOnTetrahedraToo) {
  if (!test::is_installed("simpleFoam")) GTEST_SKIP() << "OpenFOAM is not installed";
  const TemporaryFolder folder;
  const std::string surface = (folder / "tube.vtp").string();
  ASSERT_EQ(run_hexwall({"generate", "cylinder", "-o", surface, "--edge", "0.03"}).exit_code, 0);
  const std::string run = (folder / "run").string();
  const auto made = run_hexwall(
      {"case", surface, "-o", run, "--mesh", "tet", "--size", "0.45", "--re", "100", "--quiet"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  ASSERT_EQ(test::run_case(run), "");
  ASSERT_EQ(run_hexwall({"shear", run, "-o", (folder / "shear").string()}).exit_code, 0);
  const nlohmann::json flow = json_in(folder / "run/report.json").at("flow");
  const double radius = 0.5 * flow.at("inlet").at("diameter").get<double>();
  const double exact = 4.0 * flow.at("fluid").at("viscosity").get<double>() *
                       flow.at("flow_rate").get<double>() /
                       (std::numbers::pi * std::pow(radius, 3));
  const nlohmann::json wss = json_in(folder / "shear/shear.json").at("walls").at(0).at("wss");
  EXPECT_NEAR(wss.at("mean").get<double>() / exact, 1.0, 0.03);
  EXPECT_LT(wss.at("p95").get<double>() - wss.at("p5").get<double>(), 0.2 * exact);
}

std::size_t lines_that_begin(const std::string& text, const std::string& label) {
  std::istringstream lines(text);
  std::size_t count = 0;
  for (std::string line; std::getline(lines, line);)
    if (line.rfind("  " + label + ' ', 0) == 0) ++count;
  return count;
}

TEST(CaseCommand, SaysOnceWhatEachOpeningIs) {
  const TemporaryFolder folder;
  const auto made =
      run_hexwall({"case", surface_in(folder), "-o", (folder / "run").string(), "--size", "0.8"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_EQ(lines_that_begin(made.out, "inlet"), 1) << made.out;
  EXPECT_EQ(lines_that_begin(made.out, "outlet"), 2) << made.out;
}

TEST(CaseCommand, WrongOptionsLeaveNothingBehind) {
  const TemporaryFolder folder;
  const std::string surface = surface_in(folder);
  const fs::path run = folder / "run";
  const auto refused = [&](std::vector<std::string> options, const std::string& message) {
    std::vector<std::string> command{"case", surface, "-o", run.string(), "--size", "0.8"};
    command.insert(command.end(), options.begin(), options.end());
    const auto result = run_hexwall(command);
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_NE((result.err + result.out).find(message), std::string::npos) << result.err;
    EXPECT_FALSE(fs::exists(run));
  };
  refused({"--re", "100", "--flow-rate", "2"}, "--flow-rate");
  refused({"--re", "-1"}, "--re");
  refused({"--side", "both"}, "--side in");
  refused({"--split", "loop_1:0.5"}, "NAME=SHARE");
  refused({"--split", "loop_1=1,loop_1=2"}, "twice");
  refused({"--split", "loop_9=1"}, "loop_9");
  refused({"--waveform", "q.txt"}, "--flow pulsatile");
  refused({"--inlet", "aorta"}, "aorta");
}

TEST(ShearCommand, SaysWhatIsMissing) {
  const TemporaryFolder folder;
  const auto without_density = run_hexwall({"shear", folder.path().string()});
  EXPECT_EQ(without_density.exit_code, 2);
  EXPECT_NE(without_density.err.find("--density"), std::string::npos);
  const auto without_case = run_hexwall({"shear", folder.path().string(), "--density", "1060"});
  EXPECT_EQ(without_case.exit_code, 3);
  std::ofstream(folder / "report.json") << "{}";
  const auto without_flow = run_hexwall({"shear", folder.path().string()});
  EXPECT_EQ(without_flow.exit_code, 3);
  EXPECT_NE(without_flow.err.find("no report of hexwall case"), std::string::npos);
}

}  // namespace
}  // namespace hexwall
