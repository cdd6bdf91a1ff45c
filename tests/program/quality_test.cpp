// `hexwall quality`: its words, its JSON and its exit codes, on meshes of hexwall itself.

#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "program/program_fails.h"

namespace hexwall::test {
namespace {

using nlohmann::json;

class Quality : public ProgramFails {
 protected:
  json measured(const std::string& file) const {
    const ChildResult result = run_hexwall({"quality", output_ + "/" + file, "--json"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return json::parse(result.out);
  }
  void mesh_tube() const {
    ASSERT_EQ(run_hexwall({"mesh", surface_, "-o", output_, "--size", "0.4", "-q", "--write",
                           "vtu,openfoam,abaqus,gmsh"})
                  .exit_code,
              0);
  }
};

TEST_F(Quality, IsTheSameInAllFormatsAndInTheReport) {
  mesh_tube();
  const json report = json::parse(bytes_of(output_ + "/report.json"));
  const json vtu = measured("wall.vtu");
  EXPECT_EQ(vtu["figures"]["cells"], report["wall"]["hexes"]);
  EXPECT_NEAR(vtu["figures"]["min_scaled_jacobian"].get<double>(),
              report["wall"]["min_scaled_jacobian"].get<double>(), 1e-12);
  for (const char* file : {"wall.msh", "wall.inp", "openfoam"}) {
    const json other = measured(file);
    EXPECT_EQ(other["elements"]["hexahedron"], report["wall"]["hexes"]) << file;
    for (const auto& [name, value] : vtu["figures"].items()) {
      // OpenFOAM has metres, and what is a length or rounding is of no interest here.
      if (name.find("olume") != std::string::npos && name.find("Ratio") == std::string::npos)
        continue;
      const double tolerance = 1e-9 * std::abs(value.get<double>()) + 1e-9;
      EXPECT_NEAR(other["figures"][name].get<double>(), value.get<double>(), tolerance)
          << file << ' ' << name;
    }
  }
  const json quads = measured("quads.vtp");
  EXPECT_EQ(quads["measured"], "surface");
  EXPECT_NEAR(quads["figures"]["min_scaled_jacobian"].get<double>(),
              report["quads"]["min_scaled_jacobian"].get<double>(), 1e-12);
}

TEST_F(Quality, FailsOnlyIfAConditionHolds) {
  EXPECT_EQ(run_hexwall({"quality", surface_, "--fail-if", "min_angle<1"}).exit_code, 0);
  const ChildResult result = run_hexwall({"quality", surface_, "--fail-if", "min_angle<1",
                                          "--fail-if", "cells > 100", "-o", output_ + ".json"});
  EXPECT_EQ(result.exit_code, 8);
  EXPECT_NE(result.err.find("cells > 100 holds"), std::string::npos) << result.err;
  EXPECT_EQ(result.err.find("min_angle<1 holds"), std::string::npos) << result.err;
  EXPECT_NE(result.out.find("triangle   192"), std::string::npos) << result.out;
  const json written = json::parse(bytes_of(output_ + ".json"));
  EXPECT_EQ(written["conditions"][0]["holds"], false);
  EXPECT_EQ(written["conditions"][1]["holds"], true);
  EXPECT_EQ(written["figures"]["cells"], 192);
}

TEST_F(Quality, SaysWhatIsWrong) {
  expect_failure(3, {"none.vtu", "does not exist"}, {"quality", "none.vtu"});
  expect_failure(2, {"'cells'", "NAME OP NUMBER"}, {"quality", surface_, "--fail-if", "cells"});
  expect_failure(2, {"no figure 'max_volume'", "min_scaled_jacobian"},
                 {"quality", surface_, "--fail-if", "max_volume>1"});
  expect_failure(7, {"no/such/folder"}, {"quality", surface_, "-o", "no/such/folder/q.json"});
}

TEST_F(Quality, GivesTheSameBytesTwice) {
  const std::vector<std::string> arguments{"quality", surface_};
  EXPECT_EQ(run_hexwall(arguments).out, run_hexwall(arguments).out);
}

}  // namespace
}  // namespace hexwall::test
