#include "surface/read_text.h"

#include <bit>
#include <cstdint>
#include <cstring>
#include <string_view>

#include <fmt/format.h>

#include "core/errors.h"
#include "surface/counted.h"
#include "surface/line_reader.h"

namespace hexwall {
namespace {

using Tokens = LineReader::Tokens;

Vec3 parse_point(const LineReader& reader, const Tokens& tokens, std::size_t first) {
  if (tokens.size() < first + 3) reader.fail("a point needs 3 coordinates");
  return {reader.parse<double>(tokens[first]), reader.parse<double>(tokens[first + 1]),
          reader.parse<double>(tokens[first + 2])};
}

constexpr std::size_t stl_header_size = 84;    // 80 bytes of text and the number of triangles
constexpr std::size_t stl_triangle_size = 50;  // normal, three points, two bytes of attributes

template <typename Value>
Value read_bytes(const std::string& content, std::size_t offset) {
  static_assert(std::endian::native == std::endian::little);
  Value value;
  std::memcpy(&value, content.data() + offset, sizeof(Value));
  return value;
}

std::size_t binary_stl_size(const std::string& content) {
  return stl_header_size + stl_triangle_size * read_bytes<std::uint32_t>(content, 80);
}

// A binary header may also begin with "solid", so that the size decides first.
bool is_text_stl(const std::string& content) {
  if (content.size() >= stl_header_size && binary_stl_size(content) == content.size()) return false;
  const std::size_t first = content.find_first_not_of(" \t\r\n");
  if (first == std::string::npos || content.compare(first, 5, "solid") != 0) return false;
  return content.find('\0') == std::string::npos;
}

PolygonSoup parse_binary_stl(const std::string& content) {
  if (content.size() < stl_header_size) {
    throw ReadError(
        fmt::format("the file is truncated: a binary STL file has at least {} bytes, "
                    "this one {}",
                    stl_header_size, content.size()));
  }
  const std::size_t count = read_bytes<std::uint32_t>(content, 80);
  if (content.size() < binary_stl_size(content)) {
    throw ReadError(
        fmt::format("the binary STL file is truncated: it announces {} triangles, for "
                    "which it needs {} bytes, but has only {}",
                    count, binary_stl_size(content), content.size()));
  }
  PolygonSoup soup;
  for (std::size_t f = 0; f < count; ++f) {
    const std::size_t at = stl_header_size + stl_triangle_size * f + 12;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto p = read_bytes<std::array<float, 3>>(content, at + 12 * k);
      soup.points.emplace_back(p[0], p[1], p[2]);
    }
    const int v = static_cast<int>(3 * f);
    soup.polygons.push_back({v, v + 1, v + 2});
  }
  return soup;
}

PolygonSoup parse_text_stl(const std::string& content) {
  PolygonSoup soup;
  LineReader reader(content);
  Tokens tokens;
  std::vector<int> facet;
  bool is_inside = false;
  while (reader.next(tokens)) {
    if (tokens[0] == "facet") {
      if (is_inside) reader.fail("a facet begins inside another one");
      is_inside = true;
      facet.clear();
    } else if (tokens[0] == "vertex") {
      facet.push_back(static_cast<int>(soup.points.size()));
      soup.points.push_back(parse_point(reader, tokens, 1));
    } else if (tokens[0] == "endfacet") {
      if (facet.size() != 3) reader.fail(fmt::format("a facet has {} vertices", facet.size()));
      soup.polygons.push_back(facet);
      is_inside = false;
    }
  }
  if (is_inside) reader.fail("the file is truncated: it ends inside a facet");
  return soup;
}

int parse_obj_index(const LineReader& reader, std::string_view token, std::size_t point_count) {
  const int index = reader.parse<int>(token.substr(0, token.find('/')));
  // Negative indices count backwards from the last point read so far.
  return index < 0 ? static_cast<int>(point_count) + index : index - 1;
}

struct OffHeader {
  std::size_t points, faces;
};

OffHeader parse_off_header(LineReader& reader, Tokens& tokens) {
  if (!reader.next(tokens) || !tokens[0].ends_with("OFF")) {
    throw ReadError("the file does not begin with 'OFF'");
  }
  if (tokens[0].find_first_of("4n") != std::string_view::npos) {
    reader.fail(fmt::format("'{}' is not a surface in space", tokens[0]));
  }
  if (tokens.size() > 1 && tokens[1] == "BINARY") reader.fail("binary OFF files cannot be read");
  tokens.erase(tokens.begin());
  if (tokens.empty() && !reader.next(tokens)) reader.fail("the numbers of points and faces miss");
  if (tokens.size() < 2) reader.fail("the numbers of points and faces miss");
  return {reader.parse<std::uint32_t>(tokens[0]), reader.parse<std::uint32_t>(tokens[1])};
}

std::vector<int> parse_off_face(const LineReader& reader, const Tokens& tokens) {
  const std::size_t corners = reader.parse<std::uint32_t>(tokens[0]);
  if (tokens.size() - 1 < corners) {
    reader.fail(
        fmt::format("the face announces {} corners, but has only {}", corners, tokens.size() - 1));
  }
  std::vector<int> face;
  for (std::size_t k = 1; k <= corners; ++k) face.push_back(reader.parse<int>(tokens[k]));
  return face;
}

}  // namespace

PolygonSoup parse_stl(const std::string& content) {
  return is_text_stl(content) ? parse_text_stl(content) : parse_binary_stl(content);
}

PolygonSoup parse_obj(const std::string& content) {
  PolygonSoup soup;
  LineReader reader(content);
  Tokens tokens;
  int ignored = 0;
  while (reader.next(tokens)) {
    if (tokens[0] == "v") {
      soup.points.push_back(parse_point(reader, tokens, 1));
    } else if (tokens[0] == "f") {
      std::vector<int>& face = soup.polygons.emplace_back();
      for (std::size_t k = 1; k < tokens.size(); ++k) {
        face.push_back(parse_obj_index(reader, tokens[k], soup.points.size()));
      }
    } else if (tokens[0] == "l" || tokens[0] == "p") {
      ++ignored;
    }
  }
  if (ignored > 0) {
    soup.notes.push_back(counted(ignored, "line or point element was ignored",
                                 "line and point elements were ignored"));
  }
  return soup;
}

PolygonSoup parse_off(const std::string& content) {
  PolygonSoup soup;
  LineReader reader(content);
  Tokens tokens;
  const OffHeader header = parse_off_header(reader, tokens);
  while (soup.points.size() < header.points && reader.next(tokens)) {
    soup.points.push_back(parse_point(reader, tokens, 0));
  }
  while (soup.polygons.size() < header.faces && reader.next(tokens)) {
    soup.polygons.push_back(parse_off_face(reader, tokens));
  }
  if (soup.points.size() < header.points || soup.polygons.size() < header.faces) {
    throw ReadError(
        fmt::format("the file is truncated: it announces {} points and {} faces, but "
                    "holds {} and {}",
                    header.points, header.faces, soup.points.size(), soup.polygons.size()));
  }
  return soup;
}

}  // namespace hexwall
