#include "exporters/openfoam.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include "core/errors.h"
#include "exporters/hex_faces.h"
#include "exporters/output_file.h"
#include "exporters/text.h"

namespace hexwall {
namespace {

constexpr std::string_view kMeshFolder = "constant/polyMesh";

/// A face of the OpenFOAM mesh: a face of its owner, and the hex behind it or -1.
struct FoamFace {
  int owner;
  int local;
  int neighbour;
};

struct FoamFaces {
  std::vector<FoamFace> faces;  ///< internal faces, then those of the patches in order
  int internal = 0;
};

[[noreturn]] void inconsistent(const std::string& what) {
  throw Error(ExitCode::internal, "cannot export to OpenFOAM: " + what);
}

int count(const auto& container) {
  return static_cast<int>(container.size());
}

/// The banner every OpenFOAM file begins with. `note` is left out if empty.
std::string header(std::string_view foam_class, std::string_view location, std::string_view object,
                   const std::string& note = "") {
  Text text(512);
  text << "FoamFile\n{\n    version     2.0;\n    format      ascii;\n    class       "
       << foam_class << ";\n";
  if (!note.empty()) text << "    note        \"" << note << "\";\n";
  text << "    location    \"" << location << "\";\n    object      " << object << ";\n}\n\n";
  return text.take();
}

OutputFile mesh_file(std::string_view foam_class, std::string_view name, std::string body,
                     const std::string& note = "") {
  body.insert(0, header(foam_class, kMeshFolder, name, note));
  return {std::string(kMeshFolder) + '/' + std::string(name), std::move(body)};
}

/// Neighbours with a higher number, in ascending order: upper-triangular order.
void append_internal_faces(const HexFaceValues& neighbours, FoamFaces& result) {
  const auto by_neighbour = [](const FoamFace& a, const FoamFace& b) {
    return std::pair(a.neighbour, a.local) < std::pair(b.neighbour, b.local);
  };
  for (int hex = 0; hex < count(neighbours); ++hex) {
    const int first = count(result.faces);
    for (int i = 0; i < 6; ++i)
      if (neighbours[hex][i] > hex) result.faces.push_back({hex, i, neighbours[hex][i]});
    std::sort(result.faces.begin() + first, result.faces.end(), by_neighbour);
  }
  result.internal = count(result.faces);
}

/// Boundary faces by patch, and by owner within a patch.
void append_boundary_faces(const std::vector<std::vector<HexFace>>& of_patch, FoamFaces& result) {
  for (const std::vector<HexFace>& faces : of_patch)
    for (const HexFace& face : faces) result.faces.push_back({face.hex, face.local, -1});
}

FoamFaces foam_faces(const HexMesh& mesh) {
  const HexFaceValues neighbours = neighbours_of_hexes(mesh);
  FoamFaces result;
  result.faces.reserve(4 * mesh.hexes.size());
  append_internal_faces(neighbours, result);
  append_boundary_faces(faces_of_patches(mesh, neighbours), result);
  return result;
}

OutputFile points_file(const HexMesh& mesh, double scale) {
  Text text(64 * mesh.points.size() + 64);
  text << count(mesh.points) << "\n(\n";
  for (const Vec3& p : mesh.points)
    text << '(' << scale * p.x() << ' ' << scale * p.y() << ' ' << scale * p.z() << ")\n";
  text << ")\n";
  return mesh_file("vectorField", "points", text.take());
}

OutputFile faces_file(const HexMesh& mesh, const FoamFaces& faces) {
  Text text(40 * faces.faces.size() + 64);
  text << count(faces.faces) << "\n(\n";
  for (const FoamFace& face : faces.faces) {
    // The face points out of its owner: to the neighbour, or out of the mesh.
    const std::array<int, 4> v = hex_face(mesh, face.owner, face.local);
    text << "4(" << v[0] << ' ' << v[1] << ' ' << v[2] << ' ' << v[3] << ")\n";
  }
  text << ")\n";
  return mesh_file("faceList", "faces", text.take());
}

std::string size_note(const HexMesh& mesh, const FoamFaces& faces) {
  Text note(128);
  note << "nPoints:" << count(mesh.points) << "  nCells:" << count(mesh.hexes)
       << "  nFaces:" << count(faces.faces) << "  nInternalFaces:" << faces.internal;
  return note.take();
}

/// The `owner` or `neighbour` file: `member` of the first `n` faces.
OutputFile labels_file(std::string_view name, const FoamFaces& faces, int n, int FoamFace::*member,
                       const std::string& note) {
  Text text(10 * faces.faces.size() + 64);
  text << n << "\n(\n";
  for (int i = 0; i < n; ++i) text << faces.faces[i].*member << '\n';
  text << ")\n";
  return mesh_file("labelList", name, text.take(), note);
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

OutputFile boundary_file(const HexMesh& mesh, const FoamFaces& faces) {
  Text text(1024);
  int start = faces.internal;
  text << count(mesh.patches) << "\n(\n";
  for (const BoundaryPatch& patch : mesh.patches) {
    text << "    " << checked_word(patch.name) << "\n    {\n        type            "
         << (patch.is_wall ? "wall" : "patch") << ";\n        nFaces          "
         << count(patch.faces) << ";\n        startFace       " << start << ";\n    }\n";
    start += count(patch.faces);
  }
  text << ")\n";
  return mesh_file("polyBoundaryMesh", "boundary", text.take());
}

OutputFile zones_file(const HexMesh& mesh) {
  group_of_hexes(mesh, mesh.zones);  // OpenFOAM wants zones that do not overlap
  Text text(10 * mesh.hexes.size() + 1024);
  text << count(mesh.zones) << "\n(\n";
  for (const CellZone& zone : mesh.zones) {
    text << checked_word(zone.name) << "\n{\n    type cellZone;\ncellLabels List<label>\n"
         << count(zone.hexes) << "\n(\n";
    for (const int hex : zone.hexes) text << hex << '\n';
    text << ")\n;\n}\n";
  }
  text << ")\n";
  return mesh_file("regIOobject", "cellZones", text.take());
}

/// Numbers of a face zone's faces among the internal ones, and whether each faces its neighbour's
/// side, as OpenFOAM's faces do, or is turned over.
struct ZoneFaces {
  std::vector<int> numbers;
  std::vector<bool> flipped;
};

ZoneFaces zone_faces(const HexMesh& mesh, const FaceZone& zone, const FoamFaces& faces) {
  const HexFaceValues neighbours = neighbours_of_hexes(mesh);
  ZoneFaces result;
  for (const HexFace& face : faces_of_zone(mesh, zone, neighbours)) {
    const int other = neighbours[face.hex][face.local];
    const auto [owner, neighbour] = std::minmax(face.hex, other);
    const auto end = faces.faces.begin() + faces.internal;
    const auto found = std::lower_bound(faces.faces.begin(), end, std::pair(owner, neighbour),
                                        [](const FoamFace& f, const std::pair<int, int>& key) {
                                          return std::pair(f.owner, f.neighbour) < key;
                                        });
    result.numbers.push_back(static_cast<int>(found - faces.faces.begin()));
    result.flipped.push_back(owner != face.hex);
  }
  return result;
}

OutputFile face_zones_file(const HexMesh& mesh, const FoamFaces& faces) {
  Text text(1024);
  text << count(mesh.face_zones) << "\n(\n";
  for (const FaceZone& zone : mesh.face_zones) {
    const ZoneFaces of_zone = zone_faces(mesh, zone, faces);
    text << checked_word(zone.name) << "\n{\n    type faceZone;\nfaceLabels List<label>\n"
         << count(of_zone.numbers) << "\n(\n";
    for (const int face : of_zone.numbers) text << face << '\n';
    text << ")\n;\nflipMap List<bool>\n" << count(of_zone.flipped) << "\n(\n";
    for (const bool flipped : of_zone.flipped) text << (flipped ? "1\n" : "0\n");
    text << ")\n;\n}\n";
  }
  text << ")\n";
  return mesh_file("regIOobject", "faceZones", text.take());
}

/// The hexes of a region as a set, since zones, which may not overlap, are the layers.
OutputFile cell_set_file(const CellZone& region) {
  Text text(10 * region.hexes.size() + 64);
  text << count(region.hexes) << "\n(\n";
  for (const int hex : region.hexes) text << hex << '\n';
  text << ")\n";
  const std::string folder = std::string(kMeshFolder) + "/sets";
  return {folder + '/' + checked_word(region.name),
          header("cellSet", folder, region.name) + text.take()};
}

OutputFile dictionary(std::string_view name, std::string_view body) {
  return {"system/" + std::string(name), header("dictionary", "system", name) + std::string(body)};
}

void append_system_files(std::vector<OutputFile>& files) {
  files.push_back(dictionary("controlDict", R"(application     checkMesh;
startFrom       startTime;
startTime       0;
stopAt          endTime;
endTime         1;
deltaT          1;
writeControl    timeStep;
writeInterval   1;
)"));
  files.push_back(dictionary("fvSchemes", R"(ddtSchemes           { default steadyState; }
gradSchemes          { default Gauss linear; }
divSchemes           { default none; }
laplacianSchemes     { default Gauss linear corrected; }
interpolationSchemes { default linear; }
snGradSchemes        { default corrected; }
)"));
  files.push_back(dictionary("fvSolution", "solvers {}\n"));
}

std::vector<OutputFile> case_files(const HexMesh& mesh, double metres_per_unit) {
  const FoamFaces faces = foam_faces(mesh);
  const std::string note = size_note(mesh, faces);
  std::vector<OutputFile> files;
  files.push_back(points_file(mesh, metres_per_unit));
  files.push_back(faces_file(mesh, faces));
  files.push_back(labels_file("owner", faces, count(faces.faces), &FoamFace::owner, note));
  files.push_back(labels_file("neighbour", faces, faces.internal, &FoamFace::neighbour, note));
  files.push_back(boundary_file(mesh, faces));
  files.push_back(zones_file(mesh));
  if (!mesh.face_zones.empty()) files.push_back(face_zones_file(mesh, faces));
  if (mesh.regions.size() > 1) {
    for (const CellZone& region : mesh.regions) files.push_back(cell_set_file(region));
  }
  append_system_files(files);
  return files;
}

}  // namespace

void write_openfoam(const std::filesystem::path& case_dir, const HexMesh& mesh,
                    double metres_per_unit) {
  if (!std::isfinite(metres_per_unit) || metres_per_unit <= 0)
    inconsistent("the unit of length must be positive");
  write_output_files(case_dir, case_files(mesh, metres_per_unit));
}

}  // namespace hexwall
