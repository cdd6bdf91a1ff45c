// The options of the layers, through the command line.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "exporters/vtk_files.h"
#include "support/check_mesh.h"
#include "support/child_process.h"
#include "support/temporary_folder.h"
#include "surface/generate.h"

namespace hexwall::test {
namespace {

using nlohmann::json;

/// A tube of radius 1 and length 4 with a point array: thickness that grows along it.
class LayersOfProgram : public testing::Test {
 protected:
  LayersOfProgram() : surface_((folder_ / "tube.vtp").string()) {
    const TriangleSurface tube = cylinder(1.0, 4.0, 32, 24);
    PolyData data;
    data.points = tube.points;
    std::vector<double> thickness;
    for (const Vec3& p : tube.points) thickness.push_back(0.1 + 0.05 * p.z());
    for (const auto& triangle : tube.triangles) data.polygons.add(triangle);
    data.point_arrays.push_back({"wall_thickness", 1, thickness});
    write_vtp(surface_, data);
  }

  ChildResult mesh(std::vector<std::string> options) {
    std::vector<std::string> arguments{"mesh",   surface_, "-o", (folder_ / "out").string(),
                                       "--size", "0.3"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return run_hexwall(arguments);
  }

  json report() const { return json::parse(std::ifstream(folder_ / "out/report.json")); }

  std::string write(const std::string& name, const std::string& text) const {
    const auto path = folder_ / name;
    std::ofstream(path) << text;
    return path.string();
  }

  void expect_asked(const std::string& side, double least, double greatest, double tolerance) {
    const json asked = report()["wall"][side]["thickness_asked"];
    EXPECT_NEAR(asked["min"].get<double>(), least, tolerance);
    EXPECT_NEAR(asked["max"].get<double>(), greatest, tolerance);
  }

  TemporaryFolder folder_;
  std::string surface_;
};

TEST_F(LayersOfProgram, ThicknessIsARatioOfTheRadius) {
  ASSERT_EQ(mesh({"--thickness-ratio", "0.2"}).exit_code, 0);
  expect_asked("outward", 0.2, 0.2, 2e-3);
}

TEST_F(LayersOfProgram, ThicknessComesFromAnArray) {
  ASSERT_EQ(mesh({"--thickness-array", "wall_thickness"}).exit_code, 0);
  expect_asked("outward", 0.1, 0.3, 1e-6);
}

TEST_F(LayersOfProgram, BoundsHoldForWhatIsAsked) {
  const ChildResult run = mesh(
      {"--thickness-array", "wall_thickness", "--thickness-min", "0.15", "--thickness-max", "0.2"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  expect_asked("outward", 0.15, 0.2, 1e-12);
}

TEST_F(LayersOfProgram, ThicknessComesFromScatteredPoints) {
  std::string text = "# x y z thickness\n";
  for (double z = 0.0; z < 4.05; z += 0.1) {
    for (int i = 0; i < 12; ++i) {
      const double angle = 0.5235987755982988 * i;
      text += std::to_string(1.05 * std::cos(angle)) + ", " +
              std::to_string(1.05 * std::sin(angle)) + ", " + std::to_string(z) + ", " +
              std::to_string(0.1 + 0.05 * z) + "\n";
    }
  }
  ASSERT_EQ(mesh({"--thickness-file", write("t.csv", text)}).exit_code, 0);
  expect_asked("outward", 0.1, 0.3, 0.01);
}

TEST_F(LayersOfProgram, NamedLayersBecomeZones) {
  const ChildResult run = mesh({"--layer-spec", "intima:0.15:1,media:0.55:2,adventitia:0.30:1"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const json result = report();
  const int quads = result["quads"]["count"];
  const json zones = result["wall"]["zones"];
  ASSERT_EQ(zones.size(), 3U);
  EXPECT_EQ(zones[0]["name"], "intima");
  EXPECT_EQ(zones[1]["name"], "media");
  EXPECT_EQ(zones[1]["hexes"], 2 * quads);
  EXPECT_EQ(zones[2]["name"], "adventitia");
}

TEST_F(LayersOfProgram, BothSidesMakeOneMeshThatCheckMeshAccepts) {
  const ChildResult run = mesh({"--side", "both", "--layers", "2", "--inner-layers", "4",
                                "--inner-growth", "1.3", "--inner-thickness", "0.3"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const json wall = report()["wall"];
  EXPECT_EQ(wall["layers"], 6);
  EXPECT_EQ(wall["inward"]["thickness_asked"]["max"], 0.3);
  EXPECT_EQ(wall["zones"][0]["name"], "lumen_layer_4");
  EXPECT_EQ(wall["zones"][5]["name"], "layer_2");
  const CheckMeshResult checked = check_mesh(folder_ / "out/openfoam");
  if (!checked.available) GTEST_SKIP() << "checkMesh is not installed";
  EXPECT_TRUE(checked.ok) << checked.log;
  EXPECT_NE(checked.log.find("interface"), std::string::npos);
}

TEST_F(LayersOfProgram, StrictThicknessFailsWithTheMeshingCode) {
  const ChildResult run = mesh({"--side", "in", "--thickness", "2", "--thickness-strict"});
  EXPECT_EQ(run.exit_code, 6);
  EXPECT_NE(run.err.find("instead of 2"), std::string::npos) << run.err;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

struct Refusal {
  std::vector<std::string> options;
  const char* words;
};

TEST_F(LayersOfProgram, RefusesWhatMakesNoSense) {
  const std::string empty = write("empty.txt", "# nothing\n");
  const std::string three = write("three.txt", "0 0 0\n");
  const std::vector<Refusal> usage{
      {{"--thickness", "1", "--thickness-ratio", "0.1"}, "excludes"},
      {{"--layer-spec", "a:1:1", "--layers", "3"}, "excludes"},
      {{"--inner-thickness", "1"}, "--side both"},
      {{"--side", "across"}, "--side"},
      {{"--thickness-ratio", "-1"}, "--thickness-ratio"},
      {{"--thickness-min", "2", "--thickness-max", "1"}, "--thickness-min"},
      {{"--thickness-array", "nothing"}, "wall_thickness"},
      {{"--layer-spec", "a:1"}, "name:share:hexes"}};
  for (const Refusal& refusal : usage) {
    const ChildResult run = mesh(refusal.options);
    EXPECT_EQ(run.exit_code, 2) << refusal.options[0];
    EXPECT_NE((run.err + run.out).find(refusal.words), std::string::npos) << run.err;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
  }
  for (const Refusal& refusal :
       std::vector<Refusal>{{{"--thickness-file", "/nowhere"}, "no such file"},
                            {{"--thickness-file", empty}, "no points"},
                            {{"--thickness-file", three}, "line 1"}}) {
    const ChildResult run = mesh(refusal.options);
    EXPECT_EQ(run.exit_code, 3) << refusal.options[1];
    EXPECT_NE(run.err.find(refusal.words), std::string::npos) << run.err;
  }
}

}  // namespace
}  // namespace hexwall::test
