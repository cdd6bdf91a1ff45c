// `hexwall lumen` and `hexwall compare`.

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/child_process.h"
#include "support/temporary_folder.h"
#include "surface/generate.h"
#include "surface/write.h"

namespace hexwall::test {
namespace {

using nlohmann::json;

class LumenOfProgram : public testing::Test {
 protected:
  LumenOfProgram() : surface_((folder_ / "tube.stl").string()) {
    write_surface(surface_, cylinder(1.0, 3.0, 32, 24));
  }

  ChildResult run(const std::string& command, std::vector<std::string> options) {
    std::vector<std::string> arguments{command,  surface_, "-o", (folder_ / "out").string(),
                                       "--size", "0.4"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return run_hexwall(arguments);
  }

  void expect_usage_error(const std::vector<std::string>& options, const std::string& words) {
    const ChildResult result = run("lumen", options);
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_NE(result.err.find(words), std::string::npos) << result.err;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
  }

  json report() const { return json::parse(std::ifstream(folder_ / "out/report.json")); }

  TemporaryFolder folder_;
  std::string surface_;
};

TEST_F(LumenOfProgram, WritesTheMeshAndWhatIsKnownOfIt) {
  const ChildResult result =
      run("lumen", {"--first-height", "0.02", "--growth", "1.5", "--inlet", "loop_1"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("inlet"), std::string::npos) << result.out;
  const json lumen = report()["lumen"];
  EXPECT_EQ(lumen["cells"].get<int>(), lumen["hexahedra"].get<int>() +
                                           lumen["pyramids"].get<int>() +
                                           lumen["tetrahedra"].get<int>());
  EXPECT_TRUE(lumen["openings"][1]["inlet"].get<bool>());
  EXPECT_NEAR(report()["wall"]["inward"]["thickness_asked"]["max"].get<double>(),
              0.02 * (1.0 + 1.5 + 2.25), 1e-12);
  for (const char* file : {"lumen.vtu", "openfoam/constant/polyMesh/faces"}) {
    EXPECT_TRUE(std::filesystem::exists(folder_ / "out" / file)) << file;
  }
}

TEST_F(LumenOfProgram, OptionsThatDoNotFitTogetherAreRefused) {
  expect_usage_error({"--side", "out"}, "no layers in the lumen");
  expect_usage_error({"--side", "both", "--mesh", "tet"}, "--mesh hybrid");
  expect_usage_error({"--inlet", "aorta"}, "'aorta'");
  expect_usage_error({"--first-height", "0.02", "--thickness", "0.1"}, "--first-height");
  expect_usage_error({"--first-height", "-1"}, "positive");
  expect_usage_error({"--core-growth", "-1"}, "--core-growth");
}

TEST_F(LumenOfProgram, ComparesWithTetrahedra) {
  const ChildResult result = run("compare", {"--factors", "1.5,1"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json meshes = json::parse(std::ifstream(folder_ / "out/compare.json"))["meshes"];
  ASSERT_EQ(meshes.size(), 3U);
  EXPECT_EQ(meshes[0]["mesh"], "hybrid");
  EXPECT_NEAR(meshes[1]["size"].get<double>(), 0.6, 1e-12);
  EXPECT_LT(meshes[1]["cells"].get<int>(), meshes[2]["cells"].get<int>());
  EXPECT_LT(meshes[0]["wall_distance"].get<double>(), meshes[2]["wall_distance"].get<double>());
  std::ifstream csv(folder_ / "out/compare.csv");
  std::string line;
  int lines = 0;
  while (std::getline(csv, line)) ++lines;
  EXPECT_EQ(lines, 4);
}

}  // namespace
}  // namespace hexwall::test
