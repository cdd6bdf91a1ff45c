// Every row of outcomes.md: the program run on the surface, its counts, its meshes judged by the
// independent verifier, and OpenFOAM's checkMesh.

#include "support/outcomes.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/check_mesh.h"
#include "support/child_process.h"
#include "support/result_files.h"
#include "support/shared_data.h"
#include "support/surfaces.h"
#include "support/temporary_folder.h"

namespace hexwall::test {
namespace {

namespace fs = std::filesystem;

class Outcomes : public testing::TestWithParam<Outcome> {};

void expect_refused(const ChildResult& result, const fs::path& output) {
  EXPECT_NE(result.err.find("hexwall: error: "), std::string::npos) << result.err;
  EXPECT_NE(result.err.find(Outcomes::GetParam().words), std::string::npos) << result.err;
  EXPECT_EQ(result.out, "");
  EXPECT_FALSE(fs::exists(output));
}

void expect_check_mesh(const fs::path& folder, const std::string& expected) {
  const CheckMeshResult checked = check_mesh(folder);
  if (!checked.available) GTEST_SKIP() << "checkMesh is not installed";
  EXPECT_EQ(checked.ok, expected == "ok") << checked.log;
  if (expected == "ok") return;
  EXPECT_NE(checked.log.find(expected), std::string::npos) << checked.log;
  if (!checked.ok) GTEST_SKIP() << "known: " << expected;
}

TEST_P(Outcomes, AreThoseOfTheTable) {
  const Outcome& row = GetParam();
  const TemporaryFolder folder;
  const auto file = surface_file(row.surface, folder.path().string());
  if (!file) GTEST_SKIP() << row.surface << " is not on this machine";
  const fs::path output = folder / "out";
  std::vector<std::string> arguments{"mesh", *file, "-o", output.string()};
  arguments.insert(arguments.end(), row.options.begin(), row.options.end());
  const ChildResult result = run_hexwall(arguments);
  ASSERT_EQ(result.exit_code, row.exit_code) << result.err;
  if (row.exit_code != 0) return expect_refused(result, output);
  EXPECT_NE(result.out.find(row.words), std::string::npos) << result.out;
  EXPECT_EQ(counts_of(report_in(output)), row.counts);
  expect_valid_results(output);
  expect_check_mesh(output / "openfoam", row.check_mesh);
}

std::string row_name(const testing::TestParamInfo<Outcome>& info) {
  std::string name = info.param.surface;
  for (const std::string& option : info.param.options) name += " " + option;
  return test_name({name, info.index});
}

INSTANTIATE_TEST_SUITE_P(, Outcomes, testing::ValuesIn(outcomes()), row_name);

TEST(OutcomeTable, HasARowForEveryFileOfTheSharedData) {
  const auto folder = shared_data();
  if (!folder) GTEST_SKIP() << "no folder of shared data; set HEXWALL_SHARED_DATA";
  std::set<std::string> in_table;
  for (const Outcome& file : shared_files()) in_table.insert(file.surface);
  for (const auto& entry : fs::directory_iterator(*folder)) {
    const fs::path name = entry.path().filename();
    if (name.extension() == ".md") continue;
    EXPECT_TRUE(in_table.contains(name.string())) << name << " has no row in outcomes.md";
  }
}

}  // namespace
}  // namespace hexwall::test
