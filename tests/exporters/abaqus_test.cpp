#include "exporters/abaqus.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hex/cell_faces.h"
#include "support/block_mesh.h"
#include "support/temporary_folder.h"

namespace hexwall {
namespace {

using testing::ElementsAre;

/// The nodes of face S1 … S6 of a C3D8, by place in the element, as the Abaqus manual lists them.
constexpr std::array<std::array<int, 4>, 6> kFaces{
    {{1, 2, 3, 4}, {5, 8, 7, 6}, {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 8, 4}, {4, 8, 5, 1}}};

/// An input file: the data lines by keyword line, their fields without blanks.
using Deck = std::vector<std::pair<std::string, std::vector<std::vector<std::string>>>>;

Deck read_deck(const std::filesystem::path& path) {
  std::istringstream file(bytes_of(path));
  Deck deck;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("**")) continue;
    line.erase(std::remove(line.begin(), line.end(), ' '), line.end());
    if (line.starts_with("*")) {
      deck.push_back({line, {}});
      continue;
    }
    auto& fields = deck.back().second.emplace_back();
    std::istringstream in(line);
    for (std::string field; std::getline(in, field, ',');) fields.push_back(field);
  }
  return deck;
}

std::vector<std::string> keywords(const Deck& deck) {
  std::vector<std::string> lines;
  for (const auto& [keyword, data] : deck) lines.push_back(keyword);
  return lines;
}

std::vector<std::vector<std::string>> data_of(const Deck& deck, const std::string& keyword) {
  for (const auto& [line, data] : deck)
    if (line == keyword) return data;
  ADD_FAILURE() << "no " << keyword;
  return {};
}

std::multiset<int> sorted(const auto& list) {
  return {list.begin(), list.end()};
}

TEST(Abaqus, NumbersNodesAndElementsFromOne) {
  const TemporaryFolder folder;
  const HexMesh mesh = block_mesh({});
  write_abaqus(folder / "a.inp", mesh);
  const Deck deck = read_deck(folder / "a.inp");
  const auto nodes = data_of(deck, "*NODE");
  ASSERT_EQ(nodes.size(), mesh.points.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    ASSERT_EQ(nodes[i].size(), 4U);
    EXPECT_EQ(std::stoul(nodes[i][0]), i + 1);
    for (int d = 0; d < 3; ++d) {
      const double x = mesh.points[i][d];
      // Only what is next to nothing takes more than 20 characters.
      EXPECT_NEAR(std::stod(nodes[i][d + 1]), x, std::abs(x) < 1e-9 ? 1e-25 : 0.0);
    }
  }
  for (const CellGroup& zone : mesh.zones) {
    const auto elements = data_of(deck, "*ELEMENT,TYPE=C3D8,ELSET=" + zone.name);
    ASSERT_EQ(elements.size(), zone.cells.size());
    for (std::size_t i = 0; i < elements.size(); ++i) {
      ASSERT_EQ(elements[i].size(), 9U);
      EXPECT_EQ(std::stoi(elements[i][0]), zone.cells[i] + 1);
      for (int k = 0; k < 8; ++k)
        EXPECT_EQ(std::stoi(elements[i][k + 1]), mesh.corners(zone.cells[i])[k] + 1);
    }
  }
}

/// The vertices of the faces of the surface `name`.
std::multiset<std::multiset<int>> surface_of(const Deck& deck, const HexMesh& mesh,
                                             const std::string& name) {
  std::multiset<std::multiset<int>> faces;
  for (const auto& row : data_of(deck, "*SURFACE,NAME=" + name + ",TYPE=ELEMENT")) {
    EXPECT_EQ(row.at(1).at(0), 'S');
    std::multiset<int> face;
    for (const int corner : kFaces.at(std::stoi(row[1].substr(1)) - 1))
      face.insert(mesh.corners(std::stoi(row[0]) - 1)[corner - 1]);
    faces.insert(face);
  }
  return faces;
}

TEST(Abaqus, HasRegionsAndTheirInterface) {
  const TemporaryFolder folder;
  const HexMesh mesh = block_mesh({12, 4, 5, 1, 1.5, 3, 2});
  write_abaqus(folder / "a.inp", mesh);
  const Deck deck = read_deck(folder / "a.inp");
  for (const CellGroup& region : mesh.regions) {
    std::vector<int> hexes;
    for (const auto& row : data_of(deck, "*ELSET,ELSET=" + region.name + ",GENERATE")) {
      for (int hex = std::stoi(row.at(0)); hex <= std::stoi(row.at(1)); ++hex) {
        hexes.push_back(hex - 1);
      }
    }
    EXPECT_EQ(hexes, region.cells);
  }
  std::multiset<std::multiset<int>> expected;
  for (const CellFace& face : mesh.face_zones[0].faces) {
    expected.insert({face.vertices.begin(), face.vertices.end()});
  }
  EXPECT_EQ(surface_of(deck, mesh, "interface"), expected);
}

TEST(Abaqus, NumbersTheSixFacesOfAHex) {
  const TemporaryFolder folder;
  HexMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                 {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  mesh.add(CellShape::hexahedron, std::array{0, 1, 2, 3, 4, 5, 6, 7});
  mesh.zones = {{"all", {0}}};
  for (int i = 0; i < 6; ++i)
    mesh.patches.push_back({"face_" + std::to_string(i), false, {{cell_face(mesh, 0, i), 0}}});
  write_abaqus(folder / "a.inp", mesh);
  const Deck deck = read_deck(folder / "a.inp");
  for (const CellPatch& patch : mesh.patches)
    EXPECT_THAT(surface_of(deck, mesh, patch.name), ElementsAre(sorted(patch.faces[0].vertices)));
}

TEST(Abaqus, SurfacesAndNodeSetsAreThePatches) {
  const TemporaryFolder folder;
  const HexMesh mesh = block_mesh({});
  write_abaqus(folder / "a.inp", mesh);
  const Deck deck = read_deck(folder / "a.inp");
  for (const CellPatch& patch : mesh.patches) {
    std::multiset<std::multiset<int>> expected;
    std::set<int> expected_nodes, nodes;
    for (const CellFace& face : patch.faces) {
      expected.insert(sorted(face.vertices));
      expected_nodes.insert(face.vertices.begin(), face.vertices.end());
    }
    EXPECT_EQ(surface_of(deck, mesh, patch.name), expected) << patch.name;
    for (const auto& row : data_of(deck, "*NSET,NSET=" + patch.name)) {
      EXPECT_LE(row.size(), 16U);
      for (const std::string& node : row) EXPECT_TRUE(nodes.insert(std::stoi(node) - 1).second);
    }
    EXPECT_EQ(nodes, expected_nodes) << patch.name;
  }
}

TEST(Abaqus, HasNothingButTheMesh) {
  const TemporaryFolder folder;
  HexMesh mesh = block_mesh({3, 1, 1});
  mesh.patches.push_back({"nothing", false, {}});
  mesh.zones.push_back({"nothing", {}});
  write_abaqus(folder / "a.inp", mesh, {"C3D8R"});
  EXPECT_THAT(
      keywords(read_deck(folder / "a.inp")),
      ElementsAre("*NODE", "*ELEMENT,TYPE=C3D8R,ELSET=layer_0", "*ELSET,ELSET=wall,GENERATE",
                  "*NSET,NSET=inner_wall", "*SURFACE,NAME=inner_wall,TYPE=ELEMENT",
                  "*NSET,NSET=outer_wall", "*SURFACE,NAME=outer_wall,TYPE=ELEMENT",
                  "*NSET,NSET=loop_0", "*SURFACE,NAME=loop_0,TYPE=ELEMENT", "*NSET,NSET=loop_1",
                  "*SURFACE,NAME=loop_1,TYPE=ELEMENT"));
}

TEST(Abaqus, NamesBecomeLabels) {
  const TemporaryFolder folder;
  HexMesh mesh = block_mesh({3, 1, 1});
  const std::string long_name(90, 'n');
  mesh.zones[0].name = "2nd layer, über=all";
  mesh.patches[0].name = long_name;
  mesh.patches[1].name = std::string(80, 'N') + "x";
  mesh.patches[2].name = "";
  mesh.patches[3].name = "set_";
  write_abaqus(folder / "a.inp", mesh);
  const auto lines = keywords(read_deck(folder / "a.inp"));
  EXPECT_THAT(lines, testing::Contains("*ELEMENT,TYPE=C3D8,ELSET=set_2nd_layer____ber_all"));
  EXPECT_THAT(lines, testing::Contains("*NSET,NSET=" + std::string(80, 'n')));
  EXPECT_THAT(lines, testing::Contains("*NSET,NSET=" + std::string(78, 'N') + "_2"));
  EXPECT_THAT(lines, testing::Contains("*NSET,NSET=set_"));
  EXPECT_THAT(lines, testing::Contains("*NSET,NSET=set__2"));
}

/// CalculiX reads no more than 20 characters of a number: the exponent must be among them.
TEST(Abaqus, NumbersFitIntoTwentyCharacters) {
  const TemporaryFolder folder;
  HexMesh mesh = block_mesh({3, 1, 1});
  const std::vector<double> values{-1.2345678901234567e-5,
                                   -1.2345678901234567e-105,
                                   -0.0012345678901234567,
                                   1.0 / 3,
                                   -1234567.8901234567,
                                   1e300 / 3,
                                   -0.0,
                                   1e22};
  for (std::size_t i = 0; i < values.size(); ++i) mesh.points[i].x() = values[i];
  write_abaqus(folder / "a.inp", mesh);
  const auto nodes = data_of(read_deck(folder / "a.inp"), "*NODE");
  for (std::size_t i = 0; i < values.size(); ++i) {
    EXPECT_LE(nodes[i][1].size(), 20U) << nodes[i][1];
    EXPECT_LE(std::abs(std::stod(nodes[i][1]) - values[i]), 5e-13 * std::abs(values[i]));
  }
  EXPECT_EQ(std::stod(nodes[3][1]), 1.0 / 3);
  EXPECT_EQ(std::stod(nodes[4][1]), -1234567.8901234567);
}

}  // namespace
}  // namespace hexwall
