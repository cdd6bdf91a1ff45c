// Files of an OpenFOAM case of a flow. tests/flow runs such cases.

#include "exporters/openfoam_case.h"

#include <map>

#include <gtest/gtest.h>

#include "support/cell_tube.h"
#include "support/child_process.h"
#include "support/expect_error.h"
#include "support/foam_run.h"
#include "support/temporary_folder.h"

namespace hexwall {
namespace {

namespace fs = std::filesystem;

constexpr double millimetre = 1e-3;

void write(const fs::path& folder, const FlowOptions& options, int processes) {
  const CellMesh mesh = cell_tube({});
  write_openfoam_case(folder, mesh, set_up_flow(mesh, openings(CellTube{}), options, millimetre),
                      {millimetre, processes});
}

std::map<std::string, std::string> files_of(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file())
      files[fs::relative(entry.path(), folder).string()] = bytes_of(entry.path());
  }
  return files;
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

FlowOptions pulse() {
  FlowOptions options;
  options.pulsatile = true;
  options.cycles = 2;
  return options;
}

TEST(OpenFoamCase, EqualInputGivesEqualBytes) {
  const TemporaryFolder folder;
  for (const FlowOptions& options : {FlowOptions{}, pulse()}) {
    write(folder / "a", options, 4);
    write(folder / "b", options, 4);
    EXPECT_EQ(files_of(folder / "a"), files_of(folder / "b"));
  }
}

TEST(OpenFoamCase, ScriptsAreExecutableAndWithoutFindings) {
  const TemporaryFolder folder;
  for (const int processes : {1, 4}) {
    write(folder.path(), {}, processes);
    for (const char* script : {"Allrun", "Allclean"}) {
      EXPECT_NE(fs::status(folder / script).permissions() & fs::perms::owner_exec, fs::perms::none);
      if (!test::is_installed("shellcheck")) continue;
      const auto result = test::run_child({"shellcheck", (folder / script).string()});
      EXPECT_EQ(result.exit_code, 0) << result.out;
    }
  }
}

TEST(OpenFoamCase, CleanScriptLeavesMeshAndBoundaryValues) {
  const TemporaryFolder folder;
  write(folder.path(), pulse(), 1);
  const auto before = files_of(folder.path());
  for (const char* made : {"0.05", "1", "120", "processor0", "postProcessing"}) {
    fs::create_directories(folder / made);
    std::ofstream(folder / made / "U") << "x";
  }
  std::ofstream(folder / "log.simpleFoam") << "x";
  EXPECT_EQ(test::run_child({(folder / "Allclean").string()}).exit_code, 0);
  EXPECT_EQ(files_of(folder.path()), before);
}

TEST(OpenFoamCase, SubdomainsDivideTheLongestSide) {
  const TemporaryFolder folder;
  write(folder.path(), {}, 6);  // a tube 2 x 2 x 4
  const std::string text = bytes_of(folder / "system/decomposeParDict");
  EXPECT_TRUE(has(text, "numberOfSubdomains 6;"));
  EXPECT_TRUE(has(text, "n           (2 1 3);")) << text;
  EXPECT_TRUE(has(bytes_of(folder / "Allrun"), "-np 6 simpleFoam -parallel"));
}

TEST(OpenFoamCase, FluidIsInItsDictionary) {
  const TemporaryFolder folder;
  FlowOptions options;
  options.blood.density = 1000.0;
  options.blood.viscosity = 4e-3;
  write(folder.path(), options, 1);
  const std::string newtonian = bytes_of(folder / "constant/transportProperties");
  EXPECT_TRUE(has(newtonian, "transportModel  Newtonian;"));
  EXPECT_TRUE(has(newtonian, "nu              [0 2 -1 0 0 0 0] 4e-06;")) << newtonian;
  EXPECT_TRUE(has(bytes_of(folder / "system/controlDict"), "rhoInf          1000"));
  options.blood.model = FluidModel::carreau;
  write(folder.path(), options, 1);
  const std::string carreau = bytes_of(folder / "constant/transportProperties");
  EXPECT_TRUE(has(carreau, "transportModel  BirdCarreau;"));
  EXPECT_TRUE(has(carreau, "nuInf       [0 2 -1 0 0 0 0] 4e-06;")) << carreau;
}

TEST(OpenFoamCase, PulseHasVelocitiesForEveryTimeOfEveryCycle) {
  const TemporaryFolder folder;
  write(folder.path(), pulse(), 1);
  int times = 0;
  for (const auto& entry : fs::directory_iterator(folder / "constant/boundaryData/inlet"))
    times += entry.is_directory() ? 1 : 0;
  EXPECT_EQ(times, 201);
  EXPECT_EQ(bytes_of(folder / "constant/boundaryData/inlet/0.25/U"),
            bytes_of(folder / "constant/boundaryData/inlet/1.25/U"));
  EXPECT_TRUE(has(bytes_of(folder / "system/controlDict"), "endTime         2;"));
  EXPECT_TRUE(has(bytes_of(folder / "system/controlDict"), "timeStart       1;"));
}

TEST(OpenFoamCase, RefusesAPatchWithoutBoundaryValue) {
  const TemporaryFolder folder;
  CellMesh mesh = cell_tube({});
  const FlowSetup setup = set_up_flow(mesh, openings(CellTube{}), {}, millimetre);
  mesh.patches[0].is_wall = false;
  test::expect_error(ExitCode::internal, {"'wall'", "no opening"}, [&] {
    write_openfoam_case(folder / "case", mesh, setup, {millimetre, 1});
  });
  EXPECT_FALSE(fs::exists(folder / "case"));
}

}  // namespace
}  // namespace hexwall
