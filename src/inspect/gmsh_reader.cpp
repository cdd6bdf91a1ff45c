// Gmsh's MSH format, text, versions 2.2 and 4.1.

#include <array>
#include <cstdint>
#include <optional>
#include <unordered_map>

#include <fmt/format.h>

#include "inspect/element_kinds.h"
#include "inspect/read_mesh.h"
#include "surface/line_reader.h"

namespace hexwall {
namespace {

using Tokens = LineReader::Tokens;

struct File {
  LineReader lines;
  AnyMesh mesh = {};
  std::unordered_map<std::int64_t, int> point_of_tag = {};
};

// Corners come first, whatever the order of the element.
std::optional<ElementShape> shape_of(int type) {
  switch (type) {
    case 2:
    case 9:
    case 20:
    case 21:
    case 22:
    case 23:
    case 24:
    case 25:
      return ElementShape::triangle;
    case 3:
    case 10:
    case 16:
    case 36:
    case 37:
      return ElementShape::quad;
    case 4:
    case 11:
    case 29:
    case 30:
    case 31:
      return ElementShape::tetrahedron;
    case 5:
    case 12:
    case 17:
    case 92:
    case 93:
      return ElementShape::hexahedron;
    case 6:
    case 13:
    case 18:
      return ElementShape::wedge;
    case 7:
    case 14:
    case 19:
      return ElementShape::pyramid;
    default:
      return std::nullopt;
  }
}

bool is_point_or_line(int type) {
  return type == 1 || type == 8 || type == 15 || (type >= 26 && type <= 28);
}

Tokens next_line(File& file) {
  Tokens tokens;
  if (!file.lines.next(tokens)) file.lines.fail("the file is truncated");
  return tokens;
}

std::int64_t whole(const File& file, const Tokens& tokens, std::size_t i) {
  if (i >= tokens.size()) file.lines.fail("there are too few numbers");
  return file.lines.parse<std::int64_t>(tokens[i]);
}

std::int64_t count_at(const File& file, const Tokens& tokens, std::size_t i) {
  const std::int64_t count = whole(file, tokens, i);
  if (count < 0) file.lines.fail(fmt::format("{} is no count", count));
  return count;
}

void add_point(File& file, std::int64_t tag, const Tokens& tokens, std::size_t i) {
  if (tokens.size() < i + 3) file.lines.fail("a node needs 3 coordinates");
  Vec3 p;
  for (std::size_t k = 0; k < 3; ++k) {
    p[static_cast<int>(k)] = file.lines.parse<double>(tokens[i + k]);
  }
  file.point_of_tag[tag] = static_cast<int>(file.mesh.points.size());
  file.mesh.points.push_back(p);
}

void add_element(File& file, ElementCollector& collector, int type, const Tokens& tokens,
                 std::size_t first_node) {
  const std::int64_t tag = whole(file, tokens, 0);
  const std::optional<ElementShape> shape = shape_of(type);
  if (!shape) {
    is_point_or_line(type) ? collector.leave_out_lower() : collector.leave_out_unknown();
    return;
  }
  std::vector<int> nodes;
  for (std::size_t i = first_node; i < tokens.size(); ++i) {
    const std::int64_t node = whole(file, tokens, i);
    const auto found = file.point_of_tag.find(node);
    if (found == file.point_of_tag.end()) {
      file.lines.fail(fmt::format("element {} refers to node {}, which is not there", tag, node));
    }
    nodes.push_back(found->second);
  }
  if (!collector.add(*shape, nodes, tag)) {
    file.lines.fail(
        fmt::format("element {} of type {} has only {}", tag, type, counted(nodes.size(), "node")));
  }
}

void read_nodes_2(File& file) {
  const std::int64_t count = count_at(file, next_line(file), 0);
  for (std::int64_t i = 0; i < count; ++i) {
    const Tokens tokens = next_line(file);
    add_point(file, whole(file, tokens, 0), tokens, 1);
  }
}

// Blocks of an entity each: the tags of the nodes first, then their places.
void read_nodes_4(File& file) {
  const std::int64_t blocks = count_at(file, next_line(file), 0);
  for (std::int64_t b = 0; b < blocks; ++b) {
    const std::int64_t count = count_at(file, next_line(file), 3);
    std::vector<std::int64_t> tags;
    for (std::int64_t i = 0; i < count; ++i) tags.push_back(whole(file, next_line(file), 0));
    for (const std::int64_t tag : tags) add_point(file, tag, next_line(file), 0);
  }
}

void read_elements_2(File& file, ElementCollector& collector) {
  const std::int64_t count = count_at(file, next_line(file), 0);
  for (std::int64_t i = 0; i < count; ++i) {
    const Tokens tokens = next_line(file);
    const std::int64_t tags = count_at(file, tokens, 2);
    if (tags > static_cast<std::int64_t>(tokens.size())) file.lines.fail("there are too few tags");
    const auto type = static_cast<int>(whole(file, tokens, 1));
    add_element(file, collector, type, tokens, 3 + static_cast<std::size_t>(tags));
  }
}

void read_elements_4(File& file, ElementCollector& collector) {
  const std::int64_t blocks = count_at(file, next_line(file), 0);
  for (std::int64_t b = 0; b < blocks; ++b) {
    const Tokens head = next_line(file);
    const auto type = static_cast<int>(whole(file, head, 2));
    const std::int64_t count = count_at(file, head, 3);
    for (std::int64_t i = 0; i < count; ++i) {
      add_element(file, collector, type, next_line(file), 1);
    }
  }
}

// \returns the version: 2 or 4.
int read_format(File& file) {
  const Tokens tokens = next_line(file);
  if (tokens.size() < 2) file.lines.fail("the version and the file type miss");
  if (tokens[1] != "0") {
    file.lines.fail(
        "this is a binary file, which cannot be read. Write it as text: gmsh FILE -0 -format msh41 "
        "-o TEXT.msh");
  }
  if (tokens[0] == "4.1") return 4;
  if (tokens[0].starts_with("2")) return 2;
  file.lines.fail(
      fmt::format("version {} cannot be read: 2.2 and 4.1 can. Convert it: gmsh FILE "
                  "-0 -format msh41 -o NEW.msh",
                  tokens[0]));
}

void skip_section(File& file, const std::string& name) {
  const std::string end = "$End" + name;
  Tokens tokens;
  while (file.lines.next(tokens)) {
    if (tokens[0] == end) return;
  }
  file.lines.fail(fmt::format("the file is truncated: {} is missing", end));
}

}  // namespace

AnyMesh parse_gmsh(const std::string& content) {
  File file{LineReader(content, {" \t\v\f", ""})};
  file.mesh.label_word = "element";
  ElementCollector collector(file.mesh);
  int version = 0;
  Tokens tokens;
  while (file.lines.next(tokens)) {
    if (!tokens[0].starts_with('$')) file.lines.fail("a section beginning with '$' is expected");
    const std::string section(tokens[0].substr(1));
    if (section == "MeshFormat") {
      version = read_format(file);
    } else if (version == 0) {
      file.lines.fail("the file does not begin with $MeshFormat");
    } else if (section == "Nodes") {
      version == 4 ? read_nodes_4(file) : read_nodes_2(file);
    } else if (section == "Elements") {
      version == 4 ? read_elements_4(file, collector) : read_elements_2(file, collector);
    }
    skip_section(file, section);
  }
  collector.finish();
  return std::move(file.mesh);
}

}  // namespace hexwall
