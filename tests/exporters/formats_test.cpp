// What all formats of the hex mesh have in common.

#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <ostream>
#include <string>

#include <gtest/gtest.h>

#include "exporters/abaqus.h"
#include "exporters/gmsh.h"
#include "exporters/openfoam.h"
#include "exporters/svmultiphysics.h"
#include "exporters/vtk_files.h"
#include "support/block_mesh.h"
#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace hexwall::test {
namespace {

namespace fs = std::filesystem;

struct Writer {
  std::string name;
  std::function<void(const fs::path&, const HexMesh&)> write;
  std::string last_file;  ///< below the path, if that is a folder
};

void PrintTo(const Writer& writer, std::ostream* out) {
  *out << writer.name;
}

/// The bytes of a file, or of all files below a folder by their paths.
std::map<std::string, std::string> contents(const fs::path& path) {
  if (fs::is_regular_file(path)) return {{"", bytes_of(path)}};
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(path))
    if (entry.is_regular_file())
      files[fs::relative(entry.path(), path).string()] = bytes_of(entry.path());
  return files;
}

class Formats : public testing::TestWithParam<Writer> {
 protected:
  void write(const std::string& name, const HexMesh& mesh) const {
    GetParam().write(folder_ / name, mesh);
  }
  TemporaryFolder folder_;
};

TEST_P(Formats, GiveEqualBytesForEqualMeshes) {
  write("a", block_mesh({}));
  write("b", block_mesh({}));
  const auto a = contents(folder_ / "a");
  EXPECT_FALSE(a.empty());
  for (const auto& [file, bytes] : a) EXPECT_FALSE(bytes.empty()) << file;
  EXPECT_EQ(a, contents(folder_ / "b"));
}

TEST_P(Formats, NameThePathThatCannotBeWritten) {
  std::ofstream(folder_ / "file") << "x";
  const std::string path = (folder_ / "file/mesh").string();
  expect_error(ExitCode::write, {path.c_str(), "Not a directory"},
               [&] { write("file/mesh", block_mesh({})); });
}

TEST_P(Formats, LeaveNothingBehindWhenWritingFails) {
  // A folder in the place of the file that is written last.
  fs::create_directories(folder_ / "mesh" / GetParam().last_file / "x");
  EXPECT_THROW(write("mesh", block_mesh({})), WriteError);
  EXPECT_TRUE(contents(folder_ / "mesh").empty());
}

TEST_P(Formats, RefuseAFaceThatIsListedTwice) {
  HexMesh mesh = block_mesh({});
  mesh.patches[1].faces.push_back(mesh.patches[0].faces[0]);
  expect_error(ExitCode::internal, {"listed twice"}, [&] { write("mesh", mesh); });
  EXPECT_FALSE(fs::exists(folder_ / "mesh"));
}

TEST_P(Formats, RefuseAHexWithoutAZone) {
  HexMesh mesh = block_mesh({});
  mesh.zones[1].cells.pop_back();
  expect_error(ExitCode::internal, {"in no zone"}, [&] { write("mesh", mesh); });
  EXPECT_FALSE(fs::exists(folder_ / "mesh"));
}

/// VTU allows that: it holds the patches as a property of the hexes' faces.
TEST_P(Formats, RefuseABoundaryFaceWithoutAPatch) {
  if (GetParam().name == "Vtu") return;
  HexMesh mesh = block_mesh({});
  mesh.patches[0].faces.pop_back();
  expect_error(ExitCode::internal, {"in no patch"}, [&] { write("mesh", mesh); });
  EXPECT_FALSE(fs::exists(folder_ / "mesh"));
}

INSTANTIATE_TEST_SUITE_P(
    , Formats,
    testing::Values(
        Writer{"Vtu", [](const fs::path& p, const HexMesh& m) { write_vtu(p, m); }, ""},
        Writer{"OpenFoam", [](const fs::path& p, const HexMesh& m) { write_openfoam(p, m, 1e-3); },
               "system/fvSolution"},
        Writer{"Abaqus", [](const fs::path& p, const HexMesh& m) { write_abaqus(p, m); }, ""},
        Writer{"Gmsh", [](const fs::path& p, const HexMesh& m) { write_gmsh(p, m); }, ""},
        Writer{"SvMultiPhysics",
               [](const fs::path& p, const HexMesh& m) { write_svmultiphysics(p, m); },
               "mesh-complete.mesh.vtu"}),
    [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace hexwall::test
