// Input files of Abaqus and CalculiX: nodes and elements, of all parts.

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include "inspect/element_kinds.h"
#include "inspect/read_mesh.h"
#include "surface/line_reader.h"

namespace hexwall {
namespace {

using Tokens = LineReader::Tokens;

enum class Section { other, nodes, elements };

struct File {
  LineReader lines;
  AnyMesh mesh = {};
  std::unordered_map<std::int64_t, int> point_of_label = {};  ///< of the part
  Section section = Section::other;
  std::string type = {};                   ///< of the elements that follow
  std::optional<ElementShape> shape = {};  ///< of these; none: left out
  std::vector<std::int64_t> element = {};  ///< the label and nodes of one that is not complete
};

std::string upper(std::string_view word) {
  std::string result(word);
  for (char& c : result) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return result;
}

// The number of nodes in a type such as C3D8R or S4, behind the prefix.
int nodes_in(std::string_view digits) {
  int count = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), count);
  return count;
}

std::optional<ElementShape> solid_of(int nodes) {
  switch (nodes) {
    case 4:
    case 10:
      return ElementShape::tetrahedron;
    case 5:
    case 13:
      return ElementShape::pyramid;
    case 6:
    case 15:
      return ElementShape::wedge;
    case 8:
    case 20:
    case 27:
      return ElementShape::hexahedron;
    default:
      return std::nullopt;
  }
}

std::optional<ElementShape> shell_of(int nodes) {
  if (nodes == 3 || nodes == 6 || nodes == 7) return ElementShape::triangle;
  if (nodes == 4 || nodes == 8 || nodes == 9) return ElementShape::quad;
  return std::nullopt;
}

std::optional<ElementShape> shape_of(const std::string& type) {
  // The longest prefix first: STRI before S.
  constexpr std::array<std::string_view, 5> solids{"C3D", "DC3D", "AC3D", "FC3D", "SC"};
  constexpr std::array<std::string_view, 10> shells{"STRI", "SFM3D", "M3D", "R3D", "CPS",
                                                    "CPE",  "CAX",   "DS",  "F3D", "S"};
  for (const std::string_view prefix : solids) {
    if (type.starts_with(prefix)) return solid_of(nodes_in(type.substr(prefix.size())));
  }
  for (const std::string_view prefix : shells) {
    if (type.starts_with(prefix)) return shell_of(nodes_in(type.substr(prefix.size())));
  }
  return std::nullopt;
}

// The value of KEY=VALUE in a keyword line, in upper case; empty if it is not there.
std::string parameter(const std::string& line, const std::string& key) {
  std::string packed;
  std::copy_if(line.begin(), line.end(), std::back_inserter(packed),
               [](unsigned char c) { return std::isspace(c) == 0; });
  const std::size_t at = packed.find("," + key + "=");
  if (at == std::string::npos) return {};
  const std::size_t begin = at + key.size() + 2;
  return packed.substr(begin, packed.find(',', begin) - begin);
}

void begin_elements(File& file, const std::string& line) {
  file.section = Section::elements;
  file.type = parameter(line, "TYPE");
  if (file.type.empty()) file.lines.fail("*ELEMENT has no TYPE");
  file.shape = shape_of(file.type);
}

void read_keyword(File& file) {
  const std::string line = upper(file.lines.text());
  const std::string keyword = line.substr(0, line.find_first_of(", \t\r"));
  if (!file.element.empty()) file.lines.fail("the element before is not complete");
  file.section = Section::other;
  if (keyword == "*NODE") {
    file.section = Section::nodes;
  } else if (keyword == "*ELEMENT") {
    begin_elements(file, line);
  } else if (keyword == "*PART") {
    file.point_of_label.clear();
  } else if (keyword == "*INCLUDE") {
    file.lines.fail("the mesh may be in the file that is included: give that one to hexwall");
  }
  const bool has_mesh = file.section != Section::other;
  if (has_mesh && !parameter(line, "INPUT").empty()) {
    file.lines.fail("nodes and elements in other files cannot be read");
  }
}

void read_node(File& file, const Tokens& tokens) {
  const auto label = file.lines.parse<std::int64_t>(tokens[0]);
  Vec3 p = Vec3::Zero();  // coordinates that are left out are zero
  for (std::size_t k = 1; k < std::min<std::size_t>(tokens.size(), 4); ++k) {
    p[static_cast<int>(k) - 1] = file.lines.parse<double>(tokens[k]);
  }
  file.point_of_label[label] = static_cast<int>(file.mesh.points.size());
  file.mesh.points.push_back(p);
}

void finish_element(File& file, ElementCollector& collector) {
  const std::vector<std::int64_t> numbers = std::exchange(file.element, {});
  if (!file.shape) {
    collector.leave_out_unknown();
    return;
  }
  std::vector<int> nodes;
  for (std::size_t k = 1; k < numbers.size(); ++k) {
    const auto found = file.point_of_label.find(numbers[k]);
    if (found == file.point_of_label.end()) {
      file.lines.fail(
          fmt::format("element {} refers to node {}, which is not there", numbers[0], numbers[k]));
    }
    nodes.push_back(found->second);
  }
  if (!collector.add(*file.shape, nodes, numbers[0])) {
    file.lines.fail(fmt::format("element {} of type {} has only {}", numbers[0], file.type,
                                counted(nodes.size(), "node")));
  }
}

// An element goes on in the next line if its line ends with a comma.
void read_element(File& file, const Tokens& tokens, ElementCollector& collector) {
  for (const std::string_view token : tokens) {
    file.element.push_back(file.lines.parse<std::int64_t>(token));
  }
  const std::string_view line = file.lines.text();
  const std::size_t last = line.find_last_not_of(" \t\r");
  if (last == std::string_view::npos || line[last] != ',') finish_element(file, collector);
}

}  // namespace

AnyMesh parse_abaqus(const std::string& content) {
  File file{LineReader(content, {" \t\v\f,", "**"})};
  file.mesh.label_word = "element";
  ElementCollector collector(file.mesh);
  Tokens tokens;
  while (file.lines.next(tokens)) {
    if (tokens[0].starts_with('*')) {
      read_keyword(file);
    } else if (file.section == Section::nodes) {
      read_node(file, tokens);
    } else if (file.section == Section::elements) {
      read_element(file, tokens, collector);
    }
  }
  if (!file.element.empty()) file.lines.fail("the file is truncated: it ends in an element");
  collector.finish();
  return std::move(file.mesh);
}

}  // namespace hexwall
