#include "exporters/openfoam.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <ostream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/errors.h"
#include "exporters/foam_file.h"
#include "exporters/output_file.h"
#include "exporters/text.h"
#include "hex/cell_faces.h"

namespace hexwall {
namespace {

/// What a patch of type `mappedWall` takes its values from.
struct Sample {
  std::string region;
  std::string patch;
};

/// A mesh of the case, of a region or of all.
struct FoamMesh {
  std::shared_ptr<const CellMesh> mesh;
  std::shared_ptr<const SharedFaces> faces;
  std::string region = {};                          ///< empty: the case's own
  std::map<std::string, Sample> mapped_walls = {};  ///< by patch

  std::string folder() const {
    return "constant/" + (region.empty() ? "" : region + '/') + "polyMesh";
  }
};

[[noreturn]] void inconsistent(const std::string& what) {
  throw Error(ExitCode::internal, "cannot export to OpenFOAM: " + what);
}

int count(const auto& container) {
  return static_cast<int>(container.size());
}

/// \param append_body called when the file is written.
OutputFile mesh_file(const FoamMesh& target, std::string_view foam_class, std::string_view name,
                     std::function<void(Text&)> append_body, const std::string& note = "") {
  OutputFile file{target.folder() + '/' + std::string(name), ""};
  file.source = [header = foam_header(foam_class, target.folder(), name, note),
                 append_body = std::move(append_body)](std::ostream& stream) {
    Text text(stream);
    text << header;
    append_body(text);
    text.pass_on();
  };
  return file;
}

OutputFile mesh_file(const FoamMesh& target, std::string_view foam_class, std::string_view name,
                     const std::string& body) {
  return {target.folder() + '/' + std::string(name),
          foam_header(foam_class, target.folder(), name) + body};
}

OutputFile points_file(const FoamMesh& target, double scale) {
  return mesh_file(target, "vectorField", "points", [mesh = target.mesh, scale](Text& text) {
    text << count(mesh->points) << "\n(\n";
    for (const Vec3& p : mesh->points)
      text << '(' << scale * p.x() << ' ' << scale * p.y() << ' ' << scale * p.z() << ")\n";
    text << ")\n";
  });
}

OutputFile faces_file(const FoamMesh& target) {
  return mesh_file(target, "faceList", "faces", [faces = target.faces](Text& text) {
    text << count(faces->faces) << "\n(\n";
    for (const SharedFace& face : faces->faces) {
      const std::array<int, 4>& v = face.vertices;
      text << corner_count(v) << '(' << v[0] << ' ' << v[1] << ' ' << v[2];
      if (corner_count(v) == 4) text << ' ' << v[3];
      text << ")\n";
    }
    text << ")\n";
  });
}

std::string size_note(const FoamMesh& target) {
  Text note(128);
  note << "nPoints:" << count(target.mesh->points) << "  nCells:" << target.mesh->cells()
       << "  nFaces:" << count(target.faces->faces)
       << "  nInternalFaces:" << target.faces->internal;
  return note.take();
}

/// The `owner` or the `neighbour` file.
OutputFile labels_file(const FoamMesh& target, bool of_neighbours) {
  const auto append_labels = [faces = target.faces, of_neighbours](Text& text) {
    const int n = of_neighbours ? faces->internal : count(faces->faces);
    text << n << "\n(\n";
    for (int i = 0; i < n; ++i)
      text << (of_neighbours ? faces->faces[i].neighbour : faces->faces[i].owner) << '\n';
    text << ")\n";
  };
  return mesh_file(target, "labelList", of_neighbours ? "neighbour" : "owner", append_labels,
                   size_note(target));
}

const std::string& checked_word(const std::string& name) {
  const auto is_word_char = [](char c) {
    return c > ' ' && c < 127 &&
           std::string_view("\"'/;{}()[]#$").find(c) == std::string_view::npos;
  };
  if (name.empty() || !std::all_of(name.begin(), name.end(), is_word_char))
    inconsistent("the name '" + name + "' is not an OpenFOAM word");
  return name;
}

void append_patch(const FoamMesh& target, const CellPatch& patch, int start, Text& text) {
  const auto mapped = target.mapped_walls.find(patch.name);
  const bool is_mapped = mapped != target.mapped_walls.end();
  text << "    " << checked_word(patch.name) << "\n    {\n        type            "
       << (is_mapped ? "mappedWall" : (patch.is_wall ? "wall" : "patch"))
       << ";\n        nFaces          " << count(patch.faces) << ";\n        startFace       "
       << start << ";\n";
  if (is_mapped) {
    text << "        sampleMode      nearestPatchFace;\n        sampleRegion    "
         << mapped->second.region << ";\n        samplePatch     " << mapped->second.patch << ";\n";
  }
  text << "    }\n";
}

OutputFile boundary_file(const FoamMesh& target) {
  Text text(1024);
  int start = target.faces->internal;
  text << count(target.mesh->patches) << "\n(\n";
  for (const CellPatch& patch : target.mesh->patches) {
    append_patch(target, patch, start, text);
    start += count(patch.faces);
  }
  text << ")\n";
  return mesh_file(target, "polyBoundaryMesh", "boundary", text.take());
}

OutputFile zones_file(const FoamMesh& target) {
  group_of_cells(*target.mesh, target.mesh->zones);  // OpenFOAM wants zones that do not overlap
  for (const CellGroup& zone : target.mesh->zones) checked_word(zone.name);
  return mesh_file(target, "regIOobject", "cellZones", [mesh = target.mesh](Text& text) {
    text << count(mesh->zones) << "\n(\n";
    for (const CellGroup& zone : mesh->zones) {
      text << zone.name << "\n{\n    type cellZone;\ncellLabels List<label>\n"
           << count(zone.cells) << "\n(\n";
      for (const int cell : zone.cells) text << cell << '\n';
      text << ")\n;\n}\n";
    }
    text << ")\n";
  });
}

/// Numbers of a face zone's faces among the internal ones, and whether each faces its neighbour's
/// side, as OpenFOAM's faces do, or is turned over.
struct ZoneFaces {
  std::vector<int> numbers;
  std::vector<bool> flipped;
};

ZoneFaces zone_faces(const CellMesh& mesh, const CellPatch& zone, const SharedFaces& faces) {
  const CellFaceValues neighbours = neighbours_of_cells(mesh);
  ZoneFaces result;
  for (const LocalFace& face : faces_of_zone(mesh, zone, neighbours)) {
    const int other = neighbours[face.cell][face.local];
    const auto [owner, neighbour] = std::minmax(face.cell, other);
    const auto end = faces.faces.begin() + faces.internal;
    const auto found = std::lower_bound(faces.faces.begin(), end, std::pair(owner, neighbour),
                                        [](const SharedFace& f, const std::pair<int, int>& key) {
                                          return std::pair(f.owner, f.neighbour) < key;
                                        });
    result.numbers.push_back(static_cast<int>(found - faces.faces.begin()));
    result.flipped.push_back(owner != face.cell);
  }
  return result;
}

OutputFile face_zones_file(const FoamMesh& target) {
  const CellMesh& mesh = *target.mesh;
  Text text(1024);
  text << count(mesh.face_zones) << "\n(\n";
  for (const CellPatch& zone : mesh.face_zones) {
    const ZoneFaces of_zone = zone_faces(mesh, zone, *target.faces);
    text << checked_word(zone.name) << "\n{\n    type faceZone;\nfaceLabels List<label>\n"
         << count(of_zone.numbers) << "\n(\n";
    for (const int face : of_zone.numbers) text << face << '\n';
    text << ")\n;\nflipMap List<bool>\n" << count(of_zone.flipped) << "\n(\n";
    for (const bool flipped : of_zone.flipped) text << (flipped ? "1\n" : "0\n");
    text << ")\n;\n}\n";
  }
  text << ")\n";
  return mesh_file(target, "regIOobject", "faceZones", text.take());
}

/// The hexes of a region as a set, since zones, which may not overlap, are the layers.
OutputFile cell_set_file(const FoamMesh& target, const CellGroup& region) {
  Text text(10 * region.cells.size() + 64);
  text << count(region.cells) << "\n(\n";
  for (const int cell : region.cells) text << cell << '\n';
  text << ")\n";
  const std::string folder = target.folder() + "/sets";
  return {folder + '/' + checked_word(region.name),
          foam_header("cellSet", folder, region.name) + text.take()};
}

void append_control(std::vector<OutputFile>& files) {
  files.push_back(foam_dictionary("system", "controlDict", R"(application     checkMesh;
startFrom       startTime;
startTime       0;
stopAt          endTime;
endTime         1;
deltaT          1;
writeControl    timeStep;
writeInterval   1;
)"));
}

void append_schemes(const std::string& folder, std::vector<OutputFile>& files) {
  files.push_back(
      foam_dictionary(folder, "fvSchemes", R"(ddtSchemes           { default steadyState; }
gradSchemes          { default Gauss linear; }
divSchemes           { default none; }
laplacianSchemes     { default Gauss linear corrected; }
interpolationSchemes { default linear; }
snGradSchemes        { default corrected; }
)"));
  files.push_back(foam_dictionary(folder, "fvSolution", "solvers {}\n"));
}

void append_mesh(std::shared_ptr<const CellMesh> mesh, const std::string& region,
                 std::map<std::string, Sample> mapped_walls, double metres_per_unit,
                 std::vector<OutputFile>& files) {
  const auto faces = std::make_shared<const SharedFaces>(shared_faces(*mesh));
  const FoamMesh target{std::move(mesh), faces, region, std::move(mapped_walls)};
  files.push_back(points_file(target, metres_per_unit));
  files.push_back(faces_file(target));
  files.push_back(labels_file(target, false));
  files.push_back(labels_file(target, true));
  files.push_back(boundary_file(target));
  files.push_back(zones_file(target));
  if (!target.mesh->face_zones.empty()) files.push_back(face_zones_file(target));
  if (target.mesh->regions.size() > 1) {
    for (const CellGroup& group : target.mesh->regions) {
      files.push_back(cell_set_file(target, group));
    }
  }
}

void check_unit(double metres_per_unit) {
  if (!std::isfinite(metres_per_unit) || metres_per_unit <= 0)
    inconsistent("the unit of length must be positive");
}

void append_region(const CellMesh& mesh, int region, double metres_per_unit,
                   std::vector<OutputFile>& files) {
  const std::string& own = checked_word(mesh.regions[region].name);
  const std::string& other = checked_word(mesh.regions[1 - region].name);
  append_mesh(std::make_shared<const CellMesh>(region_mesh(mesh, region)), own,
              {{own + "_to_" + other, {other, other + "_to_" + own}}}, metres_per_unit, files);
  append_schemes("system/" + own, files);
}

}  // namespace

void write_openfoam(const std::filesystem::path& case_dir, const CellMesh& mesh,
                    double metres_per_unit) {
  check_unit(metres_per_unit);
  std::vector<OutputFile> files;
  // Not owned: it outlives the writing.
  append_mesh({std::shared_ptr<const CellMesh>(), &mesh}, "", {}, metres_per_unit, files);
  append_control(files);
  append_schemes("system", files);
  write_output_files(case_dir, files);
}

void write_openfoam_regions(const std::filesystem::path& case_dir, const CellMesh& mesh,
                            double metres_per_unit) {
  check_unit(metres_per_unit);
  if (mesh.regions.size() != 2) inconsistent("a mesh of two regions is needed");
  std::vector<OutputFile> files;
  for (int region = 0; region < 2; ++region) append_region(mesh, region, metres_per_unit, files);
  append_control(files);
  append_schemes("system", files);
  files.push_back(foam_dictionary(
      "constant", "regionProperties",
      "regions (fluid (" + mesh.regions[0].name + ") solid (" + mesh.regions[1].name + "));\n"));
  write_output_files(case_dir, files);
}

}  // namespace hexwall
