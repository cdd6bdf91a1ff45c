#include "support/surfaces.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <fstream>

#include "support/child_process.h"
#include "support/outcomes.h"
#include "support/shared_data.h"
#include "support/temporary_folder.h"
#include "surface/generate.h"
#include "surface/read.h"
#include "surface/write.h"

namespace hexwall::test {
namespace {

namespace fs = std::filesystem;

constexpr std::array<const char*, 5> shapes{"annulus", "eccentric-annulus", "cylinder",
                                            "bifurcation", "aaa"};
constexpr const char* aneurysm_file =
    "/usr/share/doc/gmsh-doc/doc/gmsh/demos/api/aneurysm_data.stl.gz";

bool is_shape(const std::string& name) {
  return std::find(shapes.begin(), shapes.end(), name) != shapes.end();
}

std::optional<std::string> unpacked_aneurysm(const std::string& folder) {
  if (!fs::exists(aneurysm_file)) return std::nullopt;
  const ChildResult unpacked = run_child({"gzip", "-dc", aneurysm_file});
  if (unpacked.exit_code != 0) return std::nullopt;
  std::string path = (fs::path(folder) / "aneurysm.stl").string();
  std::ofstream(path, std::ios::binary) << unpacked.out;
  return path;
}

}  // namespace

std::vector<std::string> meshable_surfaces() {
  std::vector<std::string> names(shapes.begin(), shapes.end());
  names.emplace_back("aneurysm");
  for (const Outcome& file : shared_files()) {
    if (file.is_clean()) names.push_back(file.surface);
  }
  return names;
}

std::optional<std::string> surface_file(const std::string& name, const std::string& folder) {
  if (name == "aneurysm") return unpacked_aneurysm(folder);
  if (is_shape(name)) {
    std::string path = (fs::path(folder) / (name + ".vtp")).string();
    write_surface(path, generate_shape(shape_from_name(name)));
    return path;
  }
  const auto shared = shared_data();
  if (!shared || !fs::exists(*shared / name)) return std::nullopt;
  return (*shared / name).string();
}

std::optional<TriangleSurface> load_surface(const std::string& name) {
  if (is_shape(name)) return generate_shape(shape_from_name(name));
  const TemporaryFolder folder;
  const auto path = surface_file(name, folder.path().string());
  if (!path) return std::nullopt;
  return read_surface(*path).surface;
}

std::string test_name(const testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  for (char& c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  }
  return name;
}

}  // namespace hexwall::test
