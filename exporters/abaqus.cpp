#include "exporters/abaqus.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <ostream>
#include <set>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "exporters/output_file.h"
#include "exporters/text.h"
#include "hex/cell_faces.h"

namespace hexwall {
namespace {

constexpr std::size_t kLongestLabel = 80;
// CalculiX reads real numbers from the first 20 characters of a field; what is beyond, such as the
// exponent, is lost without a word.
constexpr std::ptrdiff_t kLongestNumber = 20;
constexpr int kNumbersPerLine = 16;

/// The number n of the face S<n> of a C3D8 for each face of a hexahedron, see `faces_of`.
constexpr std::array<int, 6> kFaceNumber{6, 4, 3, 5, 1, 2};

bool is_letter(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) != 0;
}

std::string label_of(std::string_view name) {
  std::string label = !name.empty() && is_letter(name[0]) ? "" : "set_";
  for (const char c : name) label += is_letter(c) || (c >= '0' && c <= '9') ? c : '_';
  return label.substr(0, kLongestLabel);
}

std::string upper_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

/// One label per item of `list`, all different in upper case.
template <typename Named>
std::vector<std::string> labels_of(const std::vector<Named>& list) {
  std::set<std::string> taken;
  std::vector<std::string> labels;
  for (const Named& item : list) {
    const std::string wanted = label_of(item.name);
    std::string label = wanted;
    for (int n = 2; !taken.insert(upper_case(label)).second; ++n) {
      const std::string suffix = fmt::format("_{}", n);
      label = wanted.substr(0, kLongestLabel - suffix.size()) + suffix;
    }
    labels.push_back(label);
  }
  return labels;
}

/// The shortest text that reads back to `x`, with fewer digits if that is too long.
std::string number(double x) {
  std::array<char, 32> digits;
  char* end = std::to_chars(digits.begin(), digits.end(), x).ptr;
  for (int precision = 17; end - digits.begin() > kLongestNumber; --precision)
    end = std::to_chars(digits.begin(), digits.end(), x, std::chars_format::general, precision).ptr;
  return {digits.begin(), end};
}

void append_nodes(const HexMesh& mesh, Text& text) {
  text << "*NODE\n";
  int id = 0;
  for (const Vec3& p : mesh.points)
    text << ++id << ", " << number(p.x()) << ", " << number(p.y()) << ", " << number(p.z()) << '\n';
}

void append_elements(const HexMesh& mesh, const std::string& type, Text& text) {
  const std::vector<std::string> labels = labels_of(mesh.zones);
  for (std::size_t z = 0; z < mesh.zones.size(); ++z) {
    if (mesh.zones[z].cells.empty()) continue;
    text << "*ELEMENT, TYPE=" << type << ", ELSET=" << labels[z] << '\n';
    for (const int hex : mesh.zones[z].cells) {
      text << hex + 1;
      for (const int v : mesh.corners(hex)) text << ", " << v + 1;
      text << '\n';
    }
  }
}

/// The regions as sets of elements, where no layer has the same name.
void append_regions(const HexMesh& mesh, Text& text) {
  for (const CellGroup& region : mesh.regions) {
    const std::string label = label_of(region.name);
    const std::vector<std::string> taken = labels_of(mesh.zones);
    if (std::any_of(taken.begin(), taken.end(),
                    [&](const std::string& zone) { return upper_case(zone) == upper_case(label); }))
      continue;
    text << "*ELSET, ELSET=" << label << ", GENERATE\n";
    // Hexes of a region are numbered in one run, or a few.
    for (std::size_t i = 0; i < region.cells.size();) {
      std::size_t last = i;
      while (last + 1 < region.cells.size() && region.cells[last + 1] == region.cells[last] + 1)
        ++last;
      text << region.cells[i] + 1 << ", " << region.cells[last] + 1 << ", 1\n";
      i = last + 1;
    }
  }
}

void append_node_set(const std::vector<CellFace>& faces, const std::string& label, Text& text) {
  std::set<int> nodes;
  for (const CellFace& face : faces) nodes.insert(face.vertices.begin(), face.vertices.end());
  text << "*NSET, NSET=" << label << '\n';
  int in_line = 0;
  for (const int v : nodes) {
    if (in_line > 0) text << (in_line % kNumbersPerLine == 0 ? ",\n" : ", ");
    text << v + 1;
    ++in_line;
  }
  text << '\n';
}

void append_surface(const std::vector<LocalFace>& faces, const std::string& label, Text& text) {
  text << "*SURFACE, NAME=" << label << ", TYPE=ELEMENT\n";
  for (const LocalFace& face : faces)
    text << face.cell + 1 << ", S" << kFaceNumber[face.local] << '\n';
}

void append_patches(const CellMesh& mesh, const std::vector<std::vector<LocalFace>>& faces,
                    Text& text) {
  const std::vector<std::string> labels = labels_of(mesh.patches);
  for (std::size_t p = 0; p < mesh.patches.size(); ++p) {
    if (faces[p].empty()) continue;
    append_node_set(mesh.patches[p].faces, labels[p], text);
    append_surface(faces[p], labels[p], text);
  }
}

void append_face_zones(const CellMesh& mesh, const CellFaceValues& neighbours, Text& text) {
  for (const CellPatch& zone : mesh.face_zones) {
    append_node_set(zone.faces, label_of(zone.name), text);
    append_surface(faces_of_zone(mesh, zone, neighbours), label_of(zone.name), text);
  }
}

}  // namespace

void write_abaqus(const std::filesystem::path& path, const HexMesh& mesh,
                  const AbaqusOptions& options) {
  const CellFaceValues neighbours = neighbours_of_cells(mesh);
  const std::vector<std::vector<LocalFace>> faces = faces_of_patches(mesh, neighbours);
  group_of_cells(mesh, mesh.zones);  // a hex in no zone would be missing in the file
  write_output_file(path, [&](std::ostream& stream) {
    Text text(stream);
    text << "** Mesh by hexwall, for *INCLUDE in a deck of Abaqus or CalculiX.\n"
            "** Lengths are in the unit of the surface that was meshed.\n"
            "** ELSETs are the cell zones and regions, NSETs and SURFACEs the boundary patches and "
            "the "
            "interface.\n";
    append_nodes(mesh, text);
    append_elements(mesh, options.element_type, text);
    append_regions(mesh, text);
    append_patches(mesh, faces, text);
    append_face_zones(mesh, neighbours, text);
    text.pass_on();
  });
}

}  // namespace hexwall
