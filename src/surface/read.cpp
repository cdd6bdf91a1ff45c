#include "surface/read.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "core/errors.h"
#include "surface/file_content.h"
#include "surface/polygon_soup.h"
#include "surface/read_legacy_vtk.h"
#include "surface/read_memory.h"
#include "surface/read_ply.h"
#include "surface/read_text.h"
#include "surface/read_vtp.h"

namespace hexwall {
namespace {

namespace fs = std::filesystem;

PolygonSoup read_stl(const fs::path& path) {
  PolygonSoup soup = parse_stl(content_of(path));
  weld_equal_points(soup);
  return soup;
}

PolygonSoup read_obj(const fs::path& path) {
  return parse_obj(content_of(path));
}

PolygonSoup read_ply(const fs::path& path) {
  return parse_ply(content_of(path));
}

PolygonSoup read_off(const fs::path& path) {
  return parse_off(content_of(path));
}

PolygonSoup read_vtp(const fs::path& path) {
  return parse_vtp(content_of(path));
}

PolygonSoup read_legacy_vtk(const fs::path& path) {
  return parse_legacy_vtk(content_of(path));
}

struct Format {
  std::string_view extension;
  PolygonSoup (*read)(const fs::path&);
};

constexpr std::array<Format, 6> formats{{{".stl", read_stl},
                                         {".obj", read_obj},
                                         {".ply", read_ply},
                                         {".off", read_off},
                                         {".vtp", read_vtp},
                                         {".vtk", read_legacy_vtk}}};

const Format& format_of(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const Format& format : formats) {
    if (format.extension == extension) return format;
  }
  std::string known;
  for (const Format& format : formats) known += fmt::format(" {}", format.extension);
  throw ReadError(fmt::format("the extension '{}' is unknown. Known are{}", extension, known));
}

}  // namespace

ReadResult read_memory(PolygonSoup soup) {
  ReadResult result;
  TriangulateResult triangulated = triangulate(soup);
  result.surface = std::move(triangulated.surface);
  result.point_arrays = follow(soup.point_arrays, triangulated.point_origin);
  result.cell_arrays = follow(soup.polygon_arrays, triangulated.triangle_origin);
  result.notes = std::move(soup.notes);
  return result;
}

ReadResult read_surface(const fs::path& path) {
  try {
    check_file(path);
    return read_memory(format_of(path).read(path));
  } catch (const ReadError& error) {
    throw ReadError(fmt::format("cannot read '{}': {}", path.string(), error.what()));
  }
}

}  // namespace hexwall
