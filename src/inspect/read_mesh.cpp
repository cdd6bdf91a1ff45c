#include "inspect/read_mesh.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

#include <fmt/format.h>

#include "core/errors.h"
#include "surface/file_content.h"
#include "surface/polygon_soup.h"
#include "surface/read_ply.h"
#include "surface/read_text.h"
#include "surface/read_vtp.h"

namespace hexwall {
namespace {

namespace fs = std::filesystem;

AnyMesh mesh_of(PolygonSoup soup) {
  AnyMesh mesh;
  mesh.label_word = "polygon";
  mesh.points = std::move(soup.points);
  mesh.notes = std::move(soup.notes);
  for (std::size_t i = 0; i < soup.polygons.size(); ++i) {
    const auto& polygon = soup.polygons[i];
    if (polygon.size() < 3) {
      throw ReadError(fmt::format("polygon {} has {} corners", i, polygon.size()));
    }
    const ElementShape shape = polygon.size() == 3   ? ElementShape::triangle
                               : polygon.size() == 4 ? ElementShape::quad
                                                     : ElementShape::polygon;
    mesh.add(shape, polygon, static_cast<std::int64_t>(i));
  }
  return mesh;
}

template <PolygonSoup (*parse)(const std::string&)>
AnyMesh parse_surface(const std::string& content) {
  return mesh_of(parse(content));
}

PolygonSoup parse_welded_stl(const std::string& content) {
  PolygonSoup soup = parse_stl(content);
  weld_equal_points(soup);
  return soup;
}

struct Format {
  std::string_view extension;
  AnyMesh (*parse)(const std::string&);
};

constexpr std::array<Format, 9> formats{{{".vtu", parse_vtu},
                                         {".vtp", parse_surface<parse_vtp>},
                                         {".vtk", parse_vtk_grid},
                                         {".msh", parse_gmsh},
                                         {".inp", parse_abaqus},
                                         {".stl", parse_surface<parse_welded_stl>},
                                         {".obj", parse_surface<parse_obj>},
                                         {".ply", parse_surface<parse_ply>},
                                         {".off", parse_surface<parse_off>}}};

const Format& format_of(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto* format = std::find_if(formats.begin(), formats.end(),
                                    [&](const Format& f) { return f.extension == extension; });
  if (format != formats.end()) return *format;
  std::string known;
  for (const Format& f : formats) known += fmt::format(" {}", f.extension);
  throw ReadError(
      fmt::format("the extension '{}' is unknown. Known are{}, and folders with an OpenFOAM mesh",
                  extension, known));
}

fs::path poly_mesh_in(const fs::path& folder) {
  for (const char* below : {"", "polyMesh", "constant/polyMesh", "openfoam/constant/polyMesh"}) {
    fs::path candidate = folder / below;
    if (fs::exists(candidate / "faces") || fs::exists(candidate / "faces.gz")) return candidate;
  }
  throw ReadError(
      "the folder holds no OpenFOAM mesh: there are no faces in it, in polyMesh or in "
      "constant/polyMesh");
}

}  // namespace

AnyMesh read_mesh(const fs::path& path) {
  try {
    AnyMesh mesh;
    if (fs::is_directory(path)) {
      mesh = read_foam(poly_mesh_in(path));
    } else {
      check_file(path);
      mesh = format_of(path).parse(content_of(path));
    }
    check_mesh_is_sound(mesh);
    orient_wedges(mesh);
    return mesh;
  } catch (const ReadError& error) {
    throw ReadError(fmt::format("cannot read '{}': {}", path.string(), error.what()));
  }
}

}  // namespace hexwall
