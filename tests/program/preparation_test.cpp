// Options of the preparation of the surface, seen from the command line: what each of them changes
// in the results.

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include "program/program_fails.h"
#include "support/capped.h"
#include "support/faults.h"
#include "support/result_files.h"
#include "support/vtk_text.h"

namespace hexwall::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using Arguments = std::vector<std::string>;

/// A tube along z from 0 to 3, closed by domes that no one can take for flat caps.
TriangleSurface capsule() {
  TriangleSurface surface = capped(cylinder(1.0, 3.0, 16, 6), CapStyle::wheel);
  for (std::size_t v = surface.points.size() - 2; v < surface.points.size(); ++v) {
    surface.points[v].z() += surface.points[v].z() > 1.0 ? 0.7 : -0.7;
  }
  return surface;
}

TriangleSurface with_fault(const std::string& name) {
  for (const std::vector<Fault>& faults : {topology_faults(), geometry_faults()}) {
    for (const Fault& fault : faults) {
      if (fault.name == name) return fault.surface;
    }
  }
  throw std::runtime_error("there is no fault " + name);
}

class Preparation : public ProgramFails {
 protected:
  std::string file_of(const TriangleSurface& surface) const {
    std::string path = (folder_ / "vessel.vtp").string();
    write_surface(path, surface);
    return path;
  }

  /// Meshes a surface coarsely and expects a valid result. \returns the report.
  json mesh(const std::string& file, const Arguments& more) {
    Arguments arguments{"mesh", file, "-o", output_, "--write", "vtu"};
    if (std::find(more.begin(), more.end(), "--size") == more.end()) {
      arguments.insert(arguments.end(), {"--size", "0.5"});
    }
    arguments.insert(arguments.end(), more.begin(), more.end());
    result_ = run_hexwall(arguments);
    if (result_.exit_code != 0) throw std::runtime_error("hexwall failed: " + result_.err);
    expect_valid_results(output_);
    return report_in(output_);
  }

  /// What `hexwall check` says of a surface.
  static json check(const std::string& file, const Arguments& more = {}) {
    Arguments arguments{"check", file, "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return json::parse(run_hexwall(arguments).out);
  }

  /// Names of the repairs that were done.
  static std::vector<std::string> repairs(const json& checked) {
    std::vector<std::string> steps;
    for (const json& repair : checked["preparation"]["repairs"]) steps.push_back(repair["step"]);
    return steps;
  }

  ChildResult result_;
};

std::vector<std::string> names_of(const json& openings) {
  std::vector<std::string> names;
  for (const json& opening : openings) names.push_back(opening["name"]);
  std::sort(names.begin(), names.end());
  return names;
}

// --- opening ------------------------------------------------------------------------------------

TEST_F(Preparation, OpensFlatCapsAndSaysSo) {
  const std::string file = file_of(capped(cylinder(1.0, 3.0, 16, 6), CapStyle::fan));
  const json report = mesh(file, {"--open", "auto"});
  const json& opened = report["preparation"]["opened"];
  ASSERT_EQ(opened.size(), 2U);
  EXPECT_EQ(names_of(opened), (Arguments{"loop_0", "loop_1"}));
  for (const json& cap : opened) {
    EXPECT_EQ(cap["how"], "flat cap");
    EXPECT_NEAR(cap["radius"].get<double>(), 1.0, 0.02);
    EXPECT_NEAR(cap["area"].get<double>(), 3.06, 0.01);
    const double z = cap["center"][2];
    EXPECT_NEAR(cap["normal"][2].get<double>(), z > 1.0 ? 1.0 : -1.0, 1e-9);
    const std::string note = "opened " + cap["name"].get<std::string>() + " (flat cap): centre (";
    EXPECT_NE(result_.out.find(note), std::string::npos) << result_.out;
  }
  expect_failure(4, {"closed"}, {"mesh", file, "-o", output_, "--open", "off"});
}

TEST_F(Preparation, OpensWhatAnArrayMarks) {
  const TriangleSurface surface = capsule();
  const std::string file = (folder_ / "capsule.vtk").string();
  Scalars part{"part", std::vector<double>(surface.triangles.size(), 0.0)};
  std::fill(part.values.end() - 32, part.values.end() - 16, 1.0);
  std::fill(part.values.end() - 16, part.values.end(), 2.0);
  write_vtk_text(file, surface, {}, part);
  expect_failure(4, {"closed"}, {"mesh", file, "-o", output_});
  const json report = mesh(file, {"--cap-array", "part"});
  EXPECT_EQ(names_of(report["input"]["openings"]), (Arguments{"part_1", "part_2"}));
  expect_failure(2, {"'sides'", "part"}, {"mesh", file, "-o", output_, "--cap-array", "sides"});
}

TEST_F(Preparation, CutsEndsOff) {
  const std::string file = file_of(capsule());
  const std::string cuts = text_file(
      "cuts.txt", "# point, normal\n0 0 0.4 0 0 -1 inlet\n0, 0, 2.6, 0, 0, 1, 1.5, out\n");
  const json report = mesh(file, {"--open-at", cuts});
  EXPECT_EQ(names_of(report["input"]["openings"]), (Arguments{"inlet", "out"}));
  for (const json& opening : report["input"]["openings"]) {
    EXPECT_NEAR(opening["center"][2].get<double>(), opening["name"] == "inlet" ? 0.4 : 2.6, 1e-9);
  }
  const std::string bad = text_file("bad.txt", "0 0 0.4 0 0 -1\n0 0 1\n");
  expect_failure(3, {"bad.txt", "line 2"}, {"mesh", file, "-o", output_, "--open-at", bad});
  expect_failure(3, {"none.txt"}, {"mesh", file, "-o", output_, "--open-at", "none.txt"});
}

TEST_F(Preparation, NamesOpenings) {
  const std::string names = text_file(
      "names.json", R"([{"name": "top", "at": [0, 0, 3.2]}, {"name": "bottom", "at": [0, 0, 0]}])");
  const json report = mesh(surface_, {"--names", names});
  EXPECT_EQ(names_of(report["input"]["openings"]), (Arguments{"bottom", "top"}));
  const auto patches = read_hex_file(fs::path(output_) / "wall.vtu").patch_names;
  EXPECT_EQ(std::set<std::string>(patches.begin(), patches.end()),
            (std::set<std::string>{"inner_wall", "outer_wall", "bottom", "top"}));
}

TEST_F(Preparation, RefusesNamesThatFitNothing) {
  const std::string far = text_file("far.json", R"([{"name": "far", "at": [0, 0, 30]}])");
  expect_usage_error({"'far'", "(0, 0, 30)", "they are at"}, {"--names", far});
  const std::string bad = text_file("bad.json", R"([{"name": "inner_wall", "at": [0, 0, 0]}])");
  expect_failure(3, {"bad.json", "entry 1"}, {"mesh", surface_, "-o", output_, "--names", bad});
}

// --- repair -------------------------------------------------------------------------------------

TEST_F(Preparation, RunsTheRepairStepsAskedFor) {
  const std::string file = file_of(with_fault("strays"));
  EXPECT_EQ(repairs(check(file)), (Arguments{"components"}));
  EXPECT_EQ(repairs(check(file, {"--repair", "components,orient"})), (Arguments{"components"}));
  for (const Arguments& without :
       {Arguments{"--repair", "weld,orient"}, Arguments{"--no-repair"}}) {
    Arguments arguments{"mesh", file, "-o", output_};
    arguments.insert(arguments.end(), without.begin(), without.end());
    expect_failure(4, {"3 connected components"}, arguments);
  }
  expect_usage_error({"'iron'", "weld", "intersections"}, {"--repair", "iron"});
  expect_usage_error({"--no-repair"}, {"--no-repair", "--repair", "weld"});
}

TEST_F(Preparation, MovesNothingFartherThanTheTolerance) {
  const std::string file = file_of(with_fault("fold"));
  const json checked = check(file, {"--tolerance", "0.1"});
  EXPECT_EQ(repairs(checked), (Arguments{"intersections"}));
  EXPECT_GT(checked["preparation"]["distance_moved"], 0.0);
  EXPECT_LE(checked["preparation"]["distance_moved"], 0.1);
  expect_failure(5, {"self-intersection", "near ("},
                 {"mesh", file, "-o", output_, "--tolerance", "1e-6"});
  for (const char* value : {"0", "-1", "nan"}) {
    expect_usage_error({"tolerance"}, {"--tolerance", value});
  }
}

TEST_F(Preparation, FillsPinholesUpToALength) {
  const std::string file = file_of(with_fault("pinholes"));
  EXPECT_EQ(check(file)["openings"].size(), 2U);
  EXPECT_EQ(check(file, {"--pinholes", "0"})["openings"].size(), 4U);
  EXPECT_EQ(check(file, {"--pinholes", "0.5"})["openings"].size(), 3U);
  expect_usage_error({"pinholes"}, {"--pinholes", "-1"});
}

TEST_F(Preparation, RemeshesIfAskedOrHopeless) {
  const std::string file = file_of(with_fault("long_triangles"));
  EXPECT_EQ(repairs(check(file)), (Arguments{"remesh"}));
  EXPECT_TRUE(repairs(check(file, {"--remesh", "off"})).empty());
  const json finer = check(surface_, {"--remesh", "0.2"});
  EXPECT_EQ(repairs(finer), (Arguments{"remesh"}));
  EXPECT_GT(finer["preparation"]["faces"], 3 * finer["input"]["faces"].get<int>());
  expect_usage_error({"2 would move the surface by", "tolerance"}, {"--remesh", "2"});
  for (const char* value : {"0", "-1", "nan", "coarse", "0.1x"}) {
    expect_usage_error({"remesh"}, {"--remesh", value});
  }
}

// --- flow extensions ----------------------------------------------------------------------------

std::set<int> values_of(vtkDataArray* array) {
  std::set<int> values;
  for (vtkIdType i = 0; array != nullptr && i < array->GetNumberOfTuples(); ++i) {
    values.insert(static_cast<int>(array->GetComponent(i, 0)));
  }
  return values;
}

TEST_F(Preparation, ExtendsAndMarksWhatItAdded) {
  const json report = mesh(surface_, {"--extend", "2"});
  for (const json& opening : report["input"]["openings"]) {
    const double z = opening["center"][2];
    EXPECT_NEAR(z, z > 1.0 ? 5.0 : -2.0, 0.1);
  }
  EXPECT_GT(report["preparation"]["extension_faces"], 0);
  const fs::path folder(output_);
  vtkNew<vtkXMLPolyDataReader> quads;
  quads->SetFileName((folder / "quads.vtp").c_str());
  quads->Update();
  auto* extension = quads->GetOutput()->GetCellData()->GetArray("extension");
  ASSERT_NE(extension, nullptr);
  for (vtkIdType i = 0; i < quads->GetOutput()->GetNumberOfCells(); ++i) {
    const double* bounds = quads->GetOutput()->GetCell(i)->GetBounds();
    const double middle = 0.5 * (bounds[4] + bounds[5]);
    if (std::abs(middle) < 0.3 || std::abs(middle - 3.0) < 0.3) continue;  // across the old end
    EXPECT_EQ(extension->GetComponent(i, 0) >= 0, middle < 0.0 || middle > 3.0) << middle;
  }
  vtkNew<vtkXMLUnstructuredGridReader> wall;
  wall->SetFileName((folder / "wall.vtu").c_str());
  wall->Update();
  EXPECT_EQ(values_of(wall->GetOutput()->GetCellData()->GetArray("extension")),
            (std::set<int>{-1, 0, 1}));
}

TEST_F(Preparation, RefusesExtensionsThatAreNone) {
  for (const char* value : {"-1", "nan", "inf", "long"}) {
    expect_usage_error({"--extend"}, {"--extend", value});
  }
}

// --- what is read -------------------------------------------------------------------------------

TEST_F(Preparation, TriangulatesQuadsAndPolygonsWithANote) {
  std::string obj;
  for (int ring = 0; ring <= 6; ++ring) {
    for (const char* xy : {"1 0", "0.5 0.866", "-0.5 0.866", "-1 0", "-0.5 -0.866", "0.5 -0.866"}) {
      obj += "v " + std::string(xy) + " " + std::to_string(0.5 * ring) + "\n";
    }
  }
  for (int i = 0; i < 36; ++i) {
    const int a = i + 1;
    const int b = i % 6 == 5 ? i - 4 : i + 2;
    for (const int v : {a, b, b + 6, a + 6}) obj += (v == a ? "f " : " ") + std::to_string(v);
    obj += "\n";
  }
  const json report = mesh(text_file("quads.obj", obj), {});
  EXPECT_EQ(report["input"]["faces"], 72);
  EXPECT_NE(result_.out.find("36 quads were split"), std::string::npos) << result_.out;
}

TEST_F(Preparation, WarnsOfUnitsThatNoVesselHas) {
  TriangleSurface surface = cylinder(1.0, 3.0, 16, 6);
  for (Vec3& p : surface.points) p *= 2e-3;
  const std::string file = file_of(surface);
  const auto warned = [&](const Arguments& more) {
    return check(file, more)["warnings"].dump().find("it would be one in m") != std::string::npos;
  };
  EXPECT_TRUE(warned({}));
  EXPECT_FALSE(warned({"--units", "m"}));
  const json report = mesh(file, {"--size", "1e-3"});
  EXPECT_NE(report["warnings"].dump().find("it would be one in m"), std::string::npos);
  EXPECT_NE(result_.out.find("warning    in the unit stated"), std::string::npos) << result_.out;
}

}  // namespace
}  // namespace hexwall::test
