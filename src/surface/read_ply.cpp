#include "surface/read_ply.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <set>
#include <string_view>

#include <fmt/format.h>

#include "core/errors.h"
#include "surface/number_source.h"

namespace hexwall {
namespace {

constexpr std::string_view blanks = " \t\r\n\v\f";

// More than any file holds, and still an integer.
constexpr double longest_list = 1e15;

struct Property {
  std::string_view name;
  Scalar type;
  std::optional<Scalar> count_type;  ///< of a list
};

struct Element {
  std::string_view name;
  std::size_t count;
  std::vector<Property> properties;
};

struct Header {
  Encoding encoding = Encoding::text;
  std::vector<Element> elements;
};

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  for (std::size_t at = line.find_first_not_of(blanks); at != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(blanks, at), line.size());
    words.push_back(line.substr(at, end - at));
    at = line.find_first_not_of(blanks, end);
  }
  return words;
}

[[noreturn]] void refuse_header(std::string_view line) {
  throw ReadError(fmt::format("the line '{}' of the header is not understood", line));
}

Scalar scalar_of(std::string_view name, std::string_view line) {
  constexpr std::array<std::array<std::string_view, 2>, 8> names{{{"char", "int8"},
                                                                  {"uchar", "uint8"},
                                                                  {"short", "int16"},
                                                                  {"ushort", "uint16"},
                                                                  {"int", "int32"},
                                                                  {"uint", "uint32"},
                                                                  {"float", "float32"},
                                                                  {"double", "float64"}}};
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (name == names[i][0] || name == names[i][1]) return static_cast<Scalar>(i);
  }
  refuse_header(line);
}

Encoding encoding_of(std::string_view name, std::string_view line) {
  if (name == "ascii") return Encoding::text;
  if (name == "binary_little_endian") return Encoding::little_endian;
  if (name == "binary_big_endian") return Encoding::big_endian;
  refuse_header(line);
}

Element element_of(const std::vector<std::string_view>& words, std::string_view line) {
  std::size_t count = 0;
  const auto [end, error] =
      std::from_chars(words[2].data(), words[2].data() + words[2].size(), count);
  if (error != std::errc{} || end != words[2].data() + words[2].size()) refuse_header(line);
  return {words[1], count, {}};
}

Property property_of(const std::vector<std::string_view>& words, std::string_view line) {
  if (words.size() == 5 && words[1] == "list") {
    return {words[4], scalar_of(words[3], line), scalar_of(words[2], line)};
  }
  if (words.size() != 3) refuse_header(line);
  return {words[2], scalar_of(words[1], line), std::nullopt};
}

Header parse_header(NumberSource& source) {
  if (words_of(source.line()) != std::vector<std::string_view>{"ply"}) {
    throw ReadError("the file does not begin with 'ply'");
  }
  Header header;
  while (true) {
    if (source.is_empty()) throw ReadError("the file is truncated: it ends within its header");
    const std::string_view line = source.line();
    const auto words = words_of(line);
    if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
    if (words[0] == "end_header") return header;
    if (words[0] == "format" && words.size() == 3) {
      header.encoding = encoding_of(words[1], line);
    } else if (words[0] == "element" && words.size() == 3) {
      header.elements.push_back(element_of(words, line));
    } else if (words[0] == "property" && !header.elements.empty()) {
      header.elements.back().properties.push_back(property_of(words, line));
    } else {
      refuse_header(line);
    }
  }
}

/// What becomes of the values of a property.
enum class Role { skipped, x, y, z, corners, array };

Role role_of(const Element& element, const Property& property) {
  const std::string_view name = property.name;
  if (element.name != "vertex" && element.name != "face") return Role::skipped;
  if (property.count_type) {
    const bool is_corners = name == "vertex_indices" || name == "vertex_index";
    return element.name == "face" && is_corners ? Role::corners : Role::skipped;
  }
  if (name == "nx" || name == "ny" || name == "nz") return Role::skipped;
  if (element.name == "vertex") {
    if (name == "x") return Role::x;
    if (name == "y") return Role::y;
    if (name == "z") return Role::z;
  }
  return Role::array;
}

void read_list(NumberSource& source, const Property& property, Encoding encoding,
               std::vector<int>* corners) {
  const double count = source.number(*property.count_type, encoding);
  if (!(count >= 0.0) || count != std::floor(count)) {
    throw ReadError(fmt::format("a list of {} values", count));
  }
  for (auto left = static_cast<std::int64_t>(std::min(count, longest_list)); left > 0; --left) {
    const double value = source.number(property.type, encoding);
    if (corners != nullptr) corners->push_back(index_of(value));
  }
}

std::vector<SurfaceArray>& arrays_of(const Element& element, PolygonSoup& soup) {
  return element.name == "face" ? soup.polygon_arrays : soup.point_arrays;
}

void add_arrays(const Element& element, PolygonSoup& soup) {
  for (const Property& property : element.properties) {
    if (role_of(element, property) != Role::array) continue;
    arrays_of(element, soup).push_back({std::string(property.name), 1, {}});
  }
}

void read_row(NumberSource& source, const Element& element, Encoding encoding, PolygonSoup& soup) {
  if (element.name == "vertex") soup.points.push_back(Vec3::Zero());
  if (element.name == "face") soup.polygons.emplace_back();
  auto array = arrays_of(element, soup).begin();
  for (const Property& property : element.properties) {
    const Role role = role_of(element, property);
    if (property.count_type) {
      read_list(source, property, encoding,
                role == Role::corners ? &soup.polygons.back() : nullptr);
      continue;
    }
    const double value = source.number(property.type, encoding);
    if (role == Role::x) soup.points.back().x() = value;
    if (role == Role::y) soup.points.back().y() = value;
    if (role == Role::z) soup.points.back().z() = value;
    if (role == Role::array) (array++)->values.push_back(value);
  }
}

void check_elements(const Header& header) {
  std::array<int, 6> found{};
  std::set<std::string_view> names;
  for (const Element& element : header.elements) {
    if (!names.insert(element.name).second) {
      throw ReadError(fmt::format("the element '{}' is announced twice", element.name));
    }
    if (element.name == "tristrips") throw ReadError("triangle strips in PLY cannot be read");
    for (const Property& p : element.properties) {
      const Role role = role_of(element, p);
      const bool may_repeat = role == Role::skipped || role == Role::array;
      if (++found[static_cast<std::size_t>(role)] == 1 || may_repeat) continue;
      throw ReadError(fmt::format("the property '{}' is announced twice", p.name));
    }
  }
  for (const Role role : {Role::x, Role::y, Role::z}) {
    if (found[static_cast<std::size_t>(role)] == 0) {
      throw ReadError("its vertices have no x, y and z");
    }
  }
  if (found[static_cast<std::size_t>(Role::corners)] == 0) {
    throw ReadError("the file holds no triangles");
  }
}

}  // namespace

PolygonSoup parse_ply(const std::string& content) {
  NumberSource source(content);
  const Header header = parse_header(source);
  check_elements(header);
  PolygonSoup soup;
  for (const Element& element : header.elements) {
    if (element.properties.empty()) continue;
    add_arrays(element, soup);
    for (std::size_t row = 0; row < element.count; ++row) {
      try {
        read_row(source, element, header.encoding, soup);
      } catch (const ReadError& error) {
        throw ReadError(fmt::format("{}, in element '{}' number {} of {}", error.what(),
                                    element.name, row + 1, element.count));
      }
    }
  }
  return soup;
}

}  // namespace hexwall
