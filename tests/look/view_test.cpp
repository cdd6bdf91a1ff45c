// The 3-D view of the report, in a headless Chromium.

#include <filesystem>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "program/program_fails.h"

namespace hexwall::test {
namespace {

using nlohmann::json;

using View = ProgramFails;

std::string program(const std::string& name) {
  std::string path = run_child({"sh", "-c", "command -v " + name}).out;
  while (path.ends_with('\n')) path.pop_back();
  return path;
}

TEST_F(View, IsUsedInABrowser) {
  const std::string modules = HEXWALL_VIEW_MODULES;
  const std::string chromium = program("chromium");
  if (modules.empty()) GTEST_SKIP() << "hexwall was built without its view: there is no Node.js";
  if (chromium.empty()) GTEST_SKIP() << "chromium is not installed";
  write_surface(surface_, generate_shape(shape_from_name("bifurcation"), 0.3));
  ASSERT_EQ(run_hexwall({"mesh", surface_, "-o", output_, "--size", "0.8", "--side", "both", "-q"})
                .exit_code,
            0);
  const ChildResult driven = run_child(
      {"timeout", "200", "node", HEXWALL_DRIVE_VIEW, output_ + "/report.html", modules, chromium});
  ASSERT_EQ(driven.exit_code, 0) << driven.err;
  const json seen = json::parse(driven.out);
  EXPECT_EQ(seen["state"], "ready");
  EXPECT_EQ(seen["messages"], json::array());
  EXPECT_EQ(seen["requests"], json::array());  // nothing beyond the file
  EXPECT_GT(seen["drawn"], 0.1);
  EXPECT_EQ(seen["changed"]["nothing"], 0.0);
  for (const char* action : {"drag", "wheel", "colour", "edges", "cut", "place", "flip"}) {
    EXPECT_GT(seen["changed"][action], 0.005) << action;
  }
  EXPECT_EQ(seen["legend"], "0\n1");  // of the scaled Jacobian
}

}  // namespace
}  // namespace hexwall::test
