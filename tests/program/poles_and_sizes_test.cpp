// --poles, --size-field and --size-by, seen from the command line.

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "program/program_fails.h"
#include "support/result_files.h"
#include "support/vessel_surfaces.h"
#include "support/vtk_text.h"

namespace hexwall::test {
namespace {

using nlohmann::json;
using Arguments = std::vector<std::string>;

/// Meshes a surface and expects a valid result. \returns the report.
json meshed(const std::string& file, const std::string& output, const Arguments& more) {
  Arguments arguments{"mesh", file, "-o", output, "--write", "vtu"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const ChildResult result = run_hexwall(arguments);
  if (result.exit_code != 0) throw std::runtime_error("hexwall failed: " + result.err);
  expect_valid_results(output);
  return report_in(output);
}

class Poles : public ProgramFails {
 protected:
  Poles() : sac_((folder_ / "sac.vtp").string()) { write_surface(sac_, tube_with_sac()); }
  json mesh(const std::string& poles) {
    return meshed(sac_, output_, {"--size", "0.3", "--poles", poles});
  }

  std::string sac_;
};

TEST_F(Poles, AreOffIfAsked) {
  const json report = mesh("off");
  EXPECT_EQ(report["options"]["poles"], "off");
  EXPECT_TRUE(report["poles"].empty());
  EXPECT_EQ(report["zeros"]["total_order"], 0.0);
  EXPECT_EQ(report["quads"]["irregular"], 0);
}

TEST_F(Poles, ComeByThemselvesInASac) {
  const json report = mesh("auto");
  const json& poles = report["poles"];
  ASSERT_GE(poles.size(), 1U);
  EXPECT_GT(poles[0]["center"][0].get<double>(), 2.0) << "not in the sac";
  for (const json& pole : poles) EXPECT_LT(pole["energy_after"], pole["energy_before"]);
  EXPECT_LT(report["quads"]["off_size_area_fraction"],
            mesh("off")["quads"]["off_size_area_fraction"]);
}

TEST_F(Poles, AreAsManyAsAskedFor) {
  for (const int count : {0, 1, 2}) {
    const json report = mesh(std::to_string(count));
    EXPECT_EQ(report["poles"].size(), static_cast<std::size_t>(count));
    EXPECT_EQ(report["options"]["poles"], std::to_string(count));
  }
}

TEST_F(Poles, GoToThePlacesOfAFile) {
  const json report = mesh(text_file("places.txt", "# one in the dome\n4.4, 0.1, 5.1\n"));
  ASSERT_EQ(report["poles"].size(), 1U);
  const std::array<double, 3> place{4.4, 0.1, 5.1};
  for (int d = 0; d < 3; ++d) {
    EXPECT_NEAR(report["poles"][0]["center"][d].get<double>(), place[d], 0.3);
  }
}

TEST_F(Poles, AreRefusedWhereTheyAreNone) {
  expect_usage_error({"--poles"}, {"--poles", "-1"});
  for (const char* value : {"many", "1.5", "Auto", ""}) {
    expect_usage_error({"--poles is auto, off, a number or a file"}, {"--poles", value});
  }
  const std::string far = text_file("far.txt", "1 0 1.5\n40 0 1.5\n");
  expect_usage_error({"(40, 0, 1.5)", "away from the surface"}, {"--poles", far});
  const std::string bad = text_file("bad.txt", "1 0 1.5\n1 0\n");
  expect_failure(3, {"bad.txt", "line 2"}, {"mesh", surface_, "-o", output_, "--poles", bad});
  const std::string none = text_file("none.txt", "# nothing\n");
  expect_failure(3, {"none.txt", "no points"}, {"mesh", surface_, "-o", output_, "--poles", none});
}

class Sizes : public ProgramFails {
 protected:
  std::string with_field(double value) const {
    const TriangleSurface surface = cylinder(1.0, 3.0, 16, 6);
    std::string path = (folder_ / "field.vtk").string();
    write_vtk_text(path, surface, {"edge", std::vector<double>(surface.points.size(), value)});
    return path;
  }
};

TEST_F(Sizes, FollowAFieldOfTheInput) {
  const json half = meshed(with_field(0.5), output_, {"--size", "0.4", "--size-field", "edge"});
  const json plain = meshed(surface_, output_, {"--size", "0.2"});
  EXPECT_EQ(half["quads"]["count"], plain["quads"]["count"]);
  EXPECT_EQ(half["options"]["size_field"], true);
  EXPECT_EQ(plain["options"]["size_field"], false);
}

TEST_F(Sizes, RefuseFieldsThatAreNone) {
  const auto refused = [&](const std::string& file, const std::string& field,
                           const std::vector<std::string>& words) {
    expect_failure(2, words, {"mesh", file, "-o", output_, "--size-field", field});
  };
  refused(with_field(1.0), "width", {"'width'", "edge"});
  refused(surface_, "edge", {"'edge'", "none"});
  refused(with_field(0.0), "edge", {"positive", "(1, 0, 3)"});
  refused(with_field(-1.0), "edge", {"positive", "(1, 0, 3)"});
}

TEST_F(Sizes, FollowTheRadiusIfAsked) {
  const std::string file = (folder_ / "bifurcation.vtp").string();
  write_surface(file, generate_shape(Shape::bifurcation, 0.25));
  const auto across = [&](const char* size_by) {
    const json report = meshed(file, output_, {"--size", "0.25", "--size-by", size_by});
    EXPECT_EQ(report["options"]["size_by_radius"], std::string(size_by) == "radius");
    return report["strips"]["quads_across"].get<std::vector<int>>();
  };
  EXPECT_NE(across("radius"), across("constant"));
  expect_usage_error({"--size-by"}, {"--size-by", "weight"});
}

}  // namespace
}  // namespace hexwall::test
