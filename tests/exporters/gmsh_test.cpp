#include "exporters/gmsh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline.h"
#include "support/block_mesh.h"
#include "support/child_process.h"
#include "support/expect_error.h"
#include "support/temporary_folder.h"
#include "surface/generate.h"

namespace hexwall::test {
namespace {

using testing::HasSubstr;
using testing::Not;

/// The lines of section `name` of a .msh file.
std::istringstream section(const std::filesystem::path& path, const std::string& name) {
  const std::string text = bytes_of(path);
  const std::size_t begin = text.find("$" + name + "\n") + name.size() + 2;
  return std::istringstream(text.substr(begin, text.find("$End" + name) - begin));
}

/// Elements by physical group, (dimension, name): the vertices of each.
using Groups = std::map<std::pair<int, std::string>, std::vector<std::vector<int>>>;

std::map<std::pair<int, int>, std::string> read_names(const std::filesystem::path& path) {
  auto in = section(path, "PhysicalNames");
  std::map<std::pair<int, int>, std::string> names;
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::istringstream words(line);
    int dimension = 0, tag = 0;
    words >> dimension >> tag;
    const std::size_t quote = line.find('"');
    names[{dimension, tag}] = line.substr(quote + 1, line.rfind('"') - quote - 1);
  }
  return names;
}

/// A point on a lattice finer than any edge, coarser than the 16 digits that Gmsh writes.
std::array<long, 3> lattice_point(const Vec3& p) {
  return {std::lround(1e9 * p.x()), std::lround(1e9 * p.y()), std::lround(1e9 * p.z())};
}

/// The vertices of `mesh` that the nodes of a file of version 2.2 are, by number: Gmsh numbers
/// anew.
std::map<int, int> vertices_of_nodes(const std::filesystem::path& path, const HexMesh& mesh) {
  std::map<std::array<long, 3>, int> vertices;
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    vertices[lattice_point(mesh.points[v])] = static_cast<int>(v);
  auto in = section(path, "Nodes");
  std::map<int, int> result;
  int count = 0;
  in >> count;
  for (int i = 0, id = 0; i < count; ++i) {
    Vec3 p;
    in >> id >> p.x() >> p.y() >> p.z();
    result[id] = vertices.at(lattice_point(p));
  }
  return result;
}

/// Elements of a file of version 2.2, which has one line per element with its physical group.
Groups read_version_2(const std::filesystem::path& path, const HexMesh& mesh) {
  const auto names = read_names(path);
  const auto vertices_of = vertices_of_nodes(path, mesh);
  auto in = section(path, "Elements");
  Groups groups;
  int count = 0;
  in >> count;
  for (int i = 0, id = 0, type = 0, tags = 0, group = 0; i < count; ++i) {
    in >> id >> type >> tags >> group;
    for (int t = 1, ignored = 0; t < tags; ++t) in >> ignored;
    std::vector<int> vertices(type == 5 ? 8 : 4);
    for (int& v : vertices) {
      in >> v;
      v = vertices_of.at(v);
    }
    groups[{type == 5 ? 3 : 2, names.at({type == 5 ? 3 : 2, group})}].push_back(vertices);
  }
  return groups;
}

Groups groups_of(const HexMesh& mesh) {
  Groups groups;
  for (const CellGroup& zone : mesh.zones)
    for (const int hex : zone.cells)
      groups[{3, zone.name}].push_back({mesh.corners(hex).begin(), mesh.corners(hex).end()});
  for (const CellPatch& patch : mesh.patches)
    for (const CellFace& face : patch.faces)
      groups[{2, patch.name}].push_back({face.vertices.begin(), face.vertices.end()});
  return groups;
}

/// In any order, faces from any vertex on.
Groups normalised(Groups groups) {
  for (auto& [group, elements] : groups) {
    if (group.first == 2)
      for (auto& e : elements)
        std::rotate(e.begin(), std::min_element(e.begin(), e.end()), e.end());
    std::sort(elements.begin(), elements.end());
  }
  return groups;
}

class Gmsh : public testing::TestWithParam<BlockTube> {};

/// Nothing between our file and Gmsh's own one is lost or turned around.
TEST_P(Gmsh, IsConvertedInSilence) {
  const TemporaryFolder folder;
  const HexMesh mesh = block_mesh(GetParam());
  write_gmsh(folder / "a.msh", mesh);
  const ChildResult run = run_child(
      {"gmsh", folder / "a.msh", "-check", "-save", "-format", "msh22", "-o", folder / "b.msh"});
  if (run.exit_code < 0) GTEST_SKIP() << "gmsh is not installed";
  EXPECT_EQ(run.exit_code, 0);
  for (const char* word : {"Warning", "Error"}) {
    EXPECT_THAT(run.out, Not(HasSubstr(word)));
    EXPECT_THAT(run.err, Not(HasSubstr(word)));
  }
  EXPECT_EQ(normalised(read_version_2(folder / "b.msh", mesh)), normalised(groups_of(mesh)));
}

INSTANTIATE_TEST_SUITE_P(Tubes, Gmsh,
                         testing::Values(BlockTube{}, BlockTube{3, 1, 1},
                                         BlockTube{24, 12, 4, 1, 1.2, 5}));

/// Regions are physical volumes beside the layers', the interface a physical surface that bounds a
/// volume on either side.
TEST(GmshFile, TwoRegionsAndTheirInterfaceHaveGroups) {
  const TemporaryFolder folder;
  write_gmsh(folder / "a.msh", block_mesh({12, 4, 5, 1, 1.5, 3, 2}));
  const auto names = read_names(folder / "a.msh");
  EXPECT_EQ(names.at({2, 5}), "interface");
  EXPECT_EQ(names.at({3, 6}), "lumen");
  EXPECT_EQ(names.at({3, 7}), "wall");
  const ChildResult run =
      run_child({"gmsh", folder / "a.msh", "-check", "-save", "-o", folder / "b.msh"});
  if (run.exit_code < 0) GTEST_SKIP() << "gmsh is not installed";
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.out + run.err, Not(HasSubstr("Warning")));
  EXPECT_THAT(run.out + run.err, Not(HasSubstr("Error")));
  EXPECT_EQ(read_names(folder / "b.msh"), names);
}

TEST(GmshFile, OfABifurcationIsConvertedInSilence) {
  const TemporaryFolder folder;
  PipelineOptions options;
  options.size = 0.3;
  const HexMesh mesh = run_pipeline(generate_shape(Shape::bifurcation, 0.25), options).wall;
  write_gmsh(folder / "a.msh", mesh);
  const ChildResult run =
      run_child({"gmsh", folder / "a.msh", "-save", "-format", "msh22", "-o", folder / "b.msh"});
  if (run.exit_code < 0) GTEST_SKIP() << "gmsh is not installed";
  EXPECT_THAT(run.out + run.err, Not(HasSubstr("Warning")));
  EXPECT_THAT(run.out + run.err, Not(HasSubstr("Error")));
  EXPECT_EQ(normalised(read_version_2(folder / "b.msh", mesh)), normalised(groups_of(mesh)));
}

struct Entity {
  int tag = 0, group = 0;
  Eigen::AlignedBox3d box;
  std::vector<int> boundary;
};

std::vector<Entity> read_entities(std::istream& in, int count) {
  std::vector<Entity> entities(count);
  for (Entity& e : entities) {
    Vec3 low, high;
    int groups = 0, boundaries = 0;
    in >> e.tag >> low.x() >> low.y() >> low.z() >> high.x() >> high.y() >> high.z();
    in >> groups >> e.group >> boundaries;
    EXPECT_EQ(groups, 1);
    e.box = {low, high};
    e.boundary.resize(boundaries);
    for (int& surface : e.boundary) in >> surface;
  }
  return entities;
}

TEST(GmshFile, EverySurfaceBoundsOneVolumeAndLiesInItsBox) {
  const TemporaryFolder folder;
  const HexMesh mesh = block_mesh({});
  write_gmsh(folder / "a.msh", mesh);
  auto in = section(folder / "a.msh", "Entities");
  int points = 0, curves = 0, surface_count = 0, volume_count = 0;
  in >> points >> curves >> surface_count >> volume_count;
  const std::vector<Entity> surfaces = read_entities(in, surface_count);
  const std::vector<Entity> volumes = read_entities(in, volume_count);
  ASSERT_EQ(volumes.size(), mesh.zones.size());
  ASSERT_EQ(surfaces.size(), 6U);  // both walls, and both ends in two layers
  std::map<int, int> bounded;
  for (const Entity& volume : volumes) {
    Eigen::AlignedBox3d box;
    for (const int hex : mesh.zones.at(volume.group - 1).cells)
      for (const int v : mesh.corners(hex)) box.extend(mesh.points[v]);
    EXPECT_EQ(volume.box.min(), box.min());
    EXPECT_EQ(volume.box.max(), box.max());
    for (const int tag : volume.boundary) {
      ++bounded[tag];
      EXPECT_TRUE(box.contains(surfaces.at(tag - 1).box));
    }
  }
  for (const Entity& surface : surfaces) EXPECT_EQ(bounded[surface.tag], 1) << surface.tag;
}

TEST(GmshFile, KeepsCoordinatesToTheLastBit) {
  const TemporaryFolder folder;
  const HexMesh mesh = block_mesh({});
  write_gmsh(folder / "a.msh", mesh);
  auto in = section(folder / "a.msh", "Nodes");
  int blocks = 0, total = 0, first = 0, last = 0;
  in >> blocks >> total >> first >> last;
  EXPECT_EQ(total, static_cast<int>(mesh.points.size()));
  int read = 0;
  for (int b = 0, dimension = 0, tag = 0, parametric = 0, size = 0; b < blocks; ++b) {
    in >> dimension >> tag >> parametric >> size;
    std::vector<int> nodes(size);
    for (int& node : nodes) in >> node;
    for (const int node : nodes) {
      std::string x, y, z;  // streams round differently
      in >> x >> y >> z;
      EXPECT_EQ(Vec3(std::stod(x), std::stod(y), std::stod(z)), mesh.points.at(node - 1));
    }
    read += size;
  }
  EXPECT_EQ(read, total);
}

TEST(GmshFile, EmptyPatchesAndZonesAreWritten) {
  const TemporaryFolder folder;
  HexMesh mesh = block_mesh({});
  mesh.patches.push_back({"no face", false, {}});
  mesh.zones.push_back({"no hex", {}});
  write_gmsh(folder / "a.msh", mesh);
  EXPECT_EQ(read_names(folder / "a.msh").at({2, 5}), "no face");
  const ChildResult run = run_child({"gmsh", folder / "a.msh", "-save", "-o", folder / "b.msh"});
  if (run.exit_code < 0) GTEST_SKIP() << "gmsh is not installed";
  EXPECT_THAT(run.out + run.err, Not(HasSubstr("Warning")));
  EXPECT_THAT(run.out + run.err, Not(HasSubstr("Error")));
}

TEST(GmshFile, RefusesNamesWithQuotes) {
  const TemporaryFolder folder;
  HexMesh mesh = block_mesh({});
  mesh.patches[2].name = "the \"end\"";
  expect_error(ExitCode::internal, {"the \"end\"", "quote"},
               [&] { write_gmsh(folder / "a.msh", mesh); });
  EXPECT_FALSE(std::filesystem::exists(folder / "a.msh"));
}

}  // namespace
}  // namespace hexwall::test
