// What the program writes and says when it succeeds.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <stdexcept>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include "support/child_process.h"
#include "support/temporary_folder.h"
#include "surface/generate.h"
#include "surface/write.h"

namespace hexwall::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

using Files = std::map<std::string, std::string>;

/// The bytes of all files below a folder, by their paths in it.
Files files_in(const fs::path& folder) {
  Files files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) {
      files[fs::relative(entry.path(), folder).string()] = bytes_of(entry.path());
    }
  }
  return files;
}

json report_in(const fs::path& folder) {
  return json::parse(bytes_of(folder / "report.json"));
}

/// Replaces the report by what must not differ between runs.
Files without_times(Files files) {
  json report = json::parse(files.at("report.json"));
  report.erase("seconds");
  report.erase("peak_memory_bytes");
  files["report.json"] = report.dump();
  std::string& page = files.at("report.html");
  const std::size_t times = page.find("<section id=\"times\">");
  page.erase(times, page.find("</section>", times) - times);
  return files;
}

template <typename Reader>
auto read_vtk(const fs::path& path) {
  vtkNew<Reader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  using Output = std::remove_pointer_t<decltype(reader->GetOutput())>;
  return vtkSmartPointer<Output>(reader->GetOutput());
}

/// The coordinates in an OpenFOAM list of vectors.
std::vector<double> foam_points(const fs::path& path) {
  const std::string text = bytes_of(path);
  static const std::regex vector(R"(\(([-+0-9.eE]+) ([-+0-9.eE]+) ([-+0-9.eE]+)\))");
  std::vector<double> values;
  for (std::sregex_iterator it(text.begin(), text.end(), vector), end; it != end; ++it) {
    for (int i = 1; i <= 3; ++i) values.push_back(std::stod((*it)[i]));
  }
  return values;
}

class Program : public testing::Test {
 protected:
  /// A bifurcation, coarse enough to be meshed in a moment.
  Program() : surface_((folder_ / "vessel.vtp").string()) {
    write_surface(surface_, generate_shape(Shape::bifurcation, 0.25));
  }

  /// Meshes into the folder `name`, with more arguments. Throws if that fails.
  fs::path mesh(const std::string& name, const std::vector<std::string>& more = {}) {
    fs::path output = folder_ / name;
    std::vector<std::string> arguments{"mesh", surface_, "-o", output.string()};
    if (std::find(more.begin(), more.end(), "--size") == more.end()) {
      arguments.insert(arguments.end(), {"--size", "0.25"});
    }
    arguments.insert(arguments.end(), more.begin(), more.end());
    result_ = run_hexwall(arguments);
    if (result_.exit_code != 0) throw std::runtime_error("hexwall failed: " + result_.err);
    return output;
  }

  TemporaryFolder folder_;
  std::string surface_;
  ChildResult result_;
};

TEST_F(Program, HelpsAndTellsItsVersion) {
  const ChildResult help = run_hexwall({"--help"});
  EXPECT_EQ(help.exit_code, 0);
  for (const char* word : {"mesh", "generate", "Exit codes"}) {
    EXPECT_NE(help.out.find(word), std::string::npos) << help.out;
  }
  const ChildResult mesh_help = run_hexwall({"mesh", "--help"});
  EXPECT_EQ(mesh_help.exit_code, 0);
  for (const char* option : {"SURFACE",
                             "--output",
                             "--size",
                             "--side",
                             "--thickness",
                             "--thickness-ratio",
                             "--thickness-array",
                             "--thickness-file",
                             "--thickness-strict",
                             "--layers",
                             "--growth",
                             "--layer-spec",
                             "--inner-thickness",
                             "--units",
                             "--relax",
                             "--poles",
                             "--write",
                             "--write-basis",
                             "--threads",
                             "--quiet",
                             "--verbose"}) {
    EXPECT_NE(mesh_help.out.find(option), std::string::npos) << option;
  }
  const ChildResult generate_help = run_hexwall({"generate", "--help"});
  EXPECT_EQ(generate_help.exit_code, 0);
  EXPECT_NE(generate_help.out.find("aaa"), std::string::npos);
  const ChildResult version = run_hexwall({"--version"});
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_TRUE(std::regex_match(version.out, std::regex("hexwall \\d+\\.\\d+\\.\\d+\n")))
      << version.out;
}

TEST_F(Program, WritesItsFiles) {
  const Files files = files_in(mesh("out"));
  std::set<std::string> names;
  for (const auto& [name, bytes] : files) names.insert(name);
  const std::set<std::string> expected{"critical.vtp",
                                       "quads.vtp",
                                       "report.html",
                                       "report.json",
                                       "surface.vtp",
                                       "wall.vtu",
                                       "openfoam/constant/polyMesh/boundary",
                                       "openfoam/constant/polyMesh/cellZones",
                                       "openfoam/constant/polyMesh/faces",
                                       "openfoam/constant/polyMesh/neighbour",
                                       "openfoam/constant/polyMesh/owner",
                                       "openfoam/constant/polyMesh/points",
                                       "openfoam/system/controlDict",
                                       "openfoam/system/fvSchemes",
                                       "openfoam/system/fvSolution"};
  EXPECT_EQ(names, expected);
  for (const auto& [name, bytes] : files) EXPECT_FALSE(bytes.empty()) << name;
}

TEST_F(Program, WritesTheFormatsAskedFor) {
  const fs::path output = mesh("out", {"--write", "abaqus,gmsh,svmultiphysics"});
  for (const char* name : {"wall.inp", "wall.msh", "mesh-complete/mesh-complete.mesh.vtu",
                           "mesh-complete/mesh-surfaces/loop_2.vtp"}) {
    EXPECT_TRUE(fs::is_regular_file(output / name)) << name;
  }
  EXPECT_FALSE(fs::exists(output / "wall.vtu"));
  EXPECT_FALSE(fs::exists(output / "openfoam"));
}

TEST_F(Program, TellsWhatItDid) {
  const fs::path output = mesh("out");
  for (const char* word : {"surface", "quads", "wall", "loop_0", "loop_2", output.c_str()}) {
    EXPECT_NE(result_.out.find(word), std::string::npos) << word << " in: " << result_.out;
  }
  EXPECT_NE(result_.err.find("[1/"), std::string::npos) << result_.err;
  EXPECT_EQ(result_.out.find(" s\n"), std::string::npos);
  mesh("verbose", {"--verbose"});
  EXPECT_TRUE(std::regex_search(result_.out, std::regex("form +[0-9.]+ s\n"))) << result_.out;
}

TEST_F(Program, IsQuietIfAsked) {
  mesh("out", {"--quiet"});
  EXPECT_EQ(result_.out, "");
  EXPECT_EQ(result_.err, "");
}

TEST_F(Program, ReportHasItsKeys) {
  const json report = report_in(mesh("out"));
  for (const char* key : {"/input/vertices",
                          "/input/faces",
                          "/input/loops",
                          "/basis/forms",
                          "/basis/error",
                          "/energy/normalized",
                          "/energy/starts",
                          "/energy/iterations",
                          "/zeros/interior",
                          "/zeros/boundary_halves",
                          "/zeros/total_order",
                          "/cylinders/count",
                          "/strips/count",
                          "/quads/count",
                          "/quads/irregular",
                          "/quads/angle_stddev_deg",
                          "/quads/min_scaled_jacobian",
                          "/quads/edge_length_quantiles",
                          "/wall/hexes",
                          "/wall/layers",
                          "/wall/min_scaled_jacobian",
                          "/wall/zones",
                          "/wall/outward/thickness_asked/min",
                          "/wall/outward/thickness_given/min",
                          "/wall/outward/reduced_area_fraction",
                          "/wall/outward/colliding_quads",
                          "/seconds/total",
                          "/peak_memory_bytes",
                          "/warnings",
                          "/options"}) {
    EXPECT_TRUE(report.contains(json::json_pointer(key))) << key;
  }
}

TEST_F(Program, ReportHasTheNumbersOfTheRun) {
  const json report = report_in(mesh("out", {"--layers", "4", "--growth", "1.25", "--thickness",
                                             "0.125", "--relax", "0.75", "--units", "cm"}));
  EXPECT_EQ(report["input"]["file"], surface_);
  EXPECT_EQ(report["input"]["loops"], 3);
  EXPECT_EQ(report["basis"]["forms"], 2);
  EXPECT_EQ(report["zeros"]["interior"], 1);
  EXPECT_EQ(report["zeros"]["boundary_halves"], 0);
  EXPECT_EQ(report["zeros"]["total_order"], 1.0);
  EXPECT_EQ(report["cylinders"]["count"], 3);
  EXPECT_EQ(report["strips"]["count"], 2);
  EXPECT_EQ(report["quads"]["irregular"], 1);
  EXPECT_EQ(report["quads"]["edge_length_quantiles"].size(), 5U);
  EXPECT_EQ(report["wall"]["layers"], 4);
  EXPECT_EQ(report["wall"]["hexes"].get<int>(), 4 * report["quads"]["count"].get<int>());
  EXPECT_EQ(report["wall"]["outward"]["thickness_asked"]["max"], 0.125);
  EXPECT_LE(report["wall"]["outward"]["thickness_given"]["min"].get<double>(), 0.125);
  const json& options = report["options"];
  EXPECT_EQ(options["size"], 0.25);
  EXPECT_EQ(options["outward"]["thickness"], 0.125);
  EXPECT_EQ(options["outward"]["layers"], 4);
  EXPECT_EQ(options["outward"]["growth"], 1.25);
  EXPECT_FALSE(options.contains("inward"));
  EXPECT_EQ(options["relax"], 0.75);
  EXPECT_EQ(options["units"], "cm");
  EXPECT_TRUE(report["warnings"].is_array());
}

TEST_F(Program, ReportHasTimesThatAddUp) {
  const json report = report_in(mesh("out"));
  double sum = 0.0;
  for (const auto& [stage, seconds] : report["seconds"].items()) {
    EXPECT_GE(seconds.get<double>(), 0.0) << stage;
    if (stage != "total") sum += seconds.get<double>();
  }
  EXPECT_NEAR(report["seconds"]["total"].get<double>(), sum, 1e-9);
  EXPECT_GT(report["peak_memory_bytes"].get<long>(), 1'000'000L);
  EXPECT_LT(report["peak_memory_bytes"].get<long>(), 4'000'000'000L);
}

TEST_F(Program, EnergyNeverRises) {
  const json energy = report_in(mesh("out"))["energy"];
  const auto iterations = energy["iterations"].get<std::vector<double>>();
  ASSERT_GE(iterations.size(), 2U);
  for (std::size_t i = 1; i < iterations.size(); ++i) EXPECT_LE(iterations[i], iterations[i - 1]);
  EXPECT_EQ(energy["normalized"].get<double>(), iterations.back());
  double least = iterations.back();
  for (const json& start : energy["starts"]) least = std::min(least, start["energy"].get<double>());
  EXPECT_NEAR(energy["normalized"].get<double>(), least, 1e-12);
  EXPECT_GE(energy["starts"].size(), 3U);
}

TEST_F(Program, WritesTheFormatsAskedForOnly) {
  const fs::path vtu = mesh("vtu", {"--write", "vtu"});
  EXPECT_TRUE(fs::exists(vtu / "wall.vtu"));
  EXPECT_FALSE(fs::exists(vtu / "openfoam"));
  const fs::path foam = mesh("foam", {"--write", "openfoam"});
  EXPECT_FALSE(fs::exists(foam / "wall.vtu"));
  EXPECT_TRUE(fs::exists(foam / "openfoam/constant/polyMesh/points"));
  const fs::path both = mesh("both", {"--write", "openfoam,vtu"});
  EXPECT_EQ(bytes_of(both / "wall.vtu"), bytes_of(vtu / "wall.vtu"));
  EXPECT_EQ(files_in(both / "openfoam"), files_in(foam / "openfoam"));
}

TEST_F(Program, WritesTheBasis) {
  const fs::path output = mesh("out", {"--write-basis"});
  const auto data = read_vtk<vtkXMLPolyDataReader>(output / "basis.vtp");
  ASSERT_GT(data->GetNumberOfPolys(), 0);
  std::set<std::string> names;
  for (int i = 0; i < data->GetPointData()->GetNumberOfArrays(); ++i) {
    names.insert(data->GetPointData()->GetArrayName(i));
  }
  EXPECT_EQ(names, (std::set<std::string>{"f_loop_1", "f_loop_2", "omega_loop_1", "omega_loop_2",
                                          "phi_loop_1", "phi_loop_2"}));
  for (const char* name : {"f_loop_1", "f_loop_2"}) {
    const auto range = data->GetPointData()->GetArray(name)->GetRange();
    EXPECT_NEAR(range[0], 0.0, 1e-12);
    EXPECT_NEAR(range[1], 1.0, 1e-12);
  }
  EXPECT_EQ(data->GetPointData()->GetArray("phi_loop_1")->GetNumberOfComponents(), 2);
  ASSERT_NE(data->GetPointData()->GetTCoords(), nullptr);
}

TEST_F(Program, FilesHaveTheCellsOfTheReport) {
  const fs::path output = mesh("out");
  const json report = report_in(output);
  const auto wall = read_vtk<vtkXMLUnstructuredGridReader>(output / "wall.vtu");
  EXPECT_EQ(wall->GetNumberOfCells(), report["wall"]["hexes"].get<int>());
  EXPECT_EQ(wall->GetNumberOfPoints(), report["wall"]["vertices"].get<int>());
  for (vtkIdType i = 0; i < wall->GetNumberOfCells(); ++i) {
    ASSERT_EQ(wall->GetCellType(i), VTK_HEXAHEDRON);
  }
  for (const char* name :
       {"layer", "quad", "zone", "patch_of_face", "cylinder", "patch", "scaled_jacobian"}) {
    EXPECT_TRUE(wall->GetCellData()->HasArray(name)) << name;
  }
  const auto range = wall->GetCellData()->GetArray("scaled_jacobian")->GetRange();
  EXPECT_NEAR(range[0], report["wall"]["min_scaled_jacobian"].get<double>(), 1e-12);
  EXPECT_GT(range[0], 0.0);

  const auto quads = read_vtk<vtkXMLPolyDataReader>(output / "quads.vtp");
  EXPECT_EQ(quads->GetNumberOfPolys(), report["quads"]["count"].get<int>());
  EXPECT_EQ(quads->GetNumberOfPoints(), report["quads"]["vertices"].get<int>());
  const auto surface = read_vtk<vtkXMLPolyDataReader>(output / "surface.vtp");
  EXPECT_EQ(surface->GetNumberOfPolys(), report["refined"]["faces"].get<int>());
  const auto critical = read_vtk<vtkXMLPolyDataReader>(output / "critical.vtp");
  EXPECT_EQ(critical->GetNumberOfVerts(), 1);
  EXPECT_GT(critical->GetNumberOfLines(), 0);
}

TEST_F(Program, ThicknessAtPointsIsAsReported) {
  const fs::path output = mesh("out", {"--size", "0.15", "--thickness", "1"});
  const auto quads = read_vtk<vtkXMLPolyDataReader>(output / "quads.vtp");
  const auto range = quads->GetPointData()->GetArray("thickness")->GetRange();
  const json wall = report_in(output)["wall"]["outward"];
  EXPECT_NEAR(range[0], wall["thickness_given"]["min"].get<double>(), 1e-12);
  EXPECT_NEAR(range[1], 1.0, 1e-12);
  EXPECT_GT(wall["reduced_area_fraction"].get<double>(), 0.0);
  EXPECT_EQ(wall["worst"]["asked"], 1.0);
  EXPECT_NE(result_.out.find("warning"), std::string::npos);
}

TEST_F(Program, OpenFoamIsInMetres) {
  const std::map<std::string, double> units{{"mm", 1e-3}, {"cm", 1e-2}, {"m", 1.0}, {"um", 1e-6}};
  for (const auto& [unit, metres] : units) {
    SCOPED_TRACE(unit);
    const fs::path output = mesh(unit, {"--units", unit});
    const auto wall = read_vtk<vtkXMLUnstructuredGridReader>(output / "wall.vtu");
    const auto values = foam_points(output / "openfoam/constant/polyMesh/points");
    ASSERT_EQ(static_cast<vtkIdType>(values.size()), 3 * wall->GetNumberOfPoints());
    for (vtkIdType i = 0; i < wall->GetNumberOfPoints(); ++i) {
      for (int d = 0; d < 3; ++d) {
        ASSERT_NEAR(values[3 * i + d], metres * wall->GetPoint(i)[d], 1e-12 * metres);
      }
    }
  }
}

TEST_F(Program, EqualRunsWriteEqualBytes) {
  const Files first = without_times(files_in(mesh("first", {"--write-basis"})));
  const Files second = without_times(files_in(mesh("second", {"--write-basis"})));
  for (const auto& [name, bytes] : first) EXPECT_TRUE(second.at(name) == bytes) << name;
  EXPECT_EQ(first.size(), second.size());
}

TEST_F(Program, ThreadsDoNotChangeABit) {
  const Files one = without_times(files_in(mesh("one", {"--threads", "1", "--write-basis"})));
  for (const char* threads : {"2", "3"}) {
    const Files more =
        without_times(files_in(mesh(threads, {"--threads", threads, "--write-basis"})));
    for (const auto& [name, bytes] : one) EXPECT_TRUE(more.at(name) == bytes) << name;
    EXPECT_EQ(one.size(), more.size());
  }
}

TEST_F(Program, ReplacesItsOwnFilesAndKeepsForeignOnes) {
  fs::create_directories(folder_ / "out/openfoam/0");
  std::ofstream(folder_ / "out/notes.txt") << "mine";
  std::ofstream(folder_ / "out/openfoam/0/p") << "pressure";
  std::ofstream(folder_ / "out/quads.vtp") << "old";
  const fs::path output = mesh("out");
  EXPECT_EQ(bytes_of(output / "notes.txt"), "mine");
  EXPECT_EQ(bytes_of(output / "openfoam/0/p"), "pressure");
  EXPECT_GT(bytes_of(output / "quads.vtp").size(), 1000U);
  EXPECT_FALSE(fs::exists(output / ".hexwall-partial"));
  Files files = without_times(files_in(output));
  files.erase("notes.txt");
  files.erase("openfoam/0/p");
  EXPECT_TRUE(files == without_times(files_in(mesh("fresh"))));
}

TEST_F(Program, MakesFoldersOnTheWay) {
  const fs::path output = mesh("a/b/c");
  EXPECT_TRUE(fs::exists(output / "report.json"));
}

class GeneratedFile : public testing::TestWithParam<std::string> {};

TEST_P(GeneratedFile, CanBeMeshed) {
  const TemporaryFolder folder;
  const std::string path = (folder / ("shape" + GetParam())).string();
  const ChildResult made = run_hexwall({"generate", "cylinder", "--edge", "0.4", "-o", path});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_NE(made.out.find("triangles"), std::string::npos) << made.out;
  const fs::path output = folder / "out";
  const ChildResult meshed =
      run_hexwall({"mesh", path, "-o", output.string(), "--size", "0.4", "--write", "vtu"});
  ASSERT_EQ(meshed.exit_code, 0) << meshed.err;
  EXPECT_EQ(report_in(output)["input"]["loops"], 2);
}

INSTANTIATE_TEST_SUITE_P(, GeneratedFile,
                         testing::Values(".stl", ".obj", ".ply", ".off", ".vtp", ".vtk"),
                         [](const auto& test) { return test.param.substr(1); });

class GeneratedShape : public testing::TestWithParam<std::string> {};

TEST_P(GeneratedShape, CanBeMeshed) {
  const TemporaryFolder folder;
  const std::string path = (folder / "shape.stl").string();
  const ChildResult made = run_hexwall({"generate", GetParam(), "-o", path});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const fs::path output = folder / "out";
  const ChildResult meshed = run_hexwall({"mesh", path, "-o", output.string()});
  ASSERT_EQ(meshed.exit_code, 0) << meshed.err;
  EXPECT_GT(report_in(output)["wall"]["min_scaled_jacobian"].get<double>(), 0.0);
}

INSTANTIATE_TEST_SUITE_P(, GeneratedShape,
                         testing::Values("annulus", "eccentric-annulus", "cylinder", "bifurcation"),
                         [](const auto& test) {
                           return test.param == "eccentric-annulus" ? "eccentric_annulus"
                                                                    : test.param;
                         });

}  // namespace
}  // namespace hexwall::test
