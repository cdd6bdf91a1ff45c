#include "exporters/svmultiphysics.h"

#include <array>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "core/errors.h"
#include "exporters/output_file.h"
#include "exporters/text.h"
#include "exporters/vtk_files.h"
#include "hex/cell_faces.h"

namespace hexwall {
namespace {

/// 1, 2, … n.
std::vector<int> numbers(std::size_t n) {
  std::vector<int> result(n);
  std::iota(result.begin(), result.end(), 1);
  return result;
}

/// `ids` counted from 1 instead of 0.
std::vector<int> from_one(std::vector<int> ids) {
  for (int& id : ids) ++id;
  return ids;
}

OutputFile volume_file(const HexMesh& mesh) {
  return {"mesh-complete.mesh.vtu",
          vtu_bytes(mesh,
                    {{"layer", 1, mesh.layer},
                     {"quad", 1, mesh.quad},
                     {"GlobalElementID", 1, numbers(mesh.shape.size())},
                     {"ModelRegionID", 1, from_one(group_of_cells(mesh, mesh.zones))}},
                    {{"GlobalNodeID", 1, numbers(mesh.points.size())}})};
}

OutputFile domains_file(const CellMesh& mesh) {
  Text text(4 * mesh.shape.size());
  for (const int zone : group_of_cells(mesh, mesh.zones)) text << zone + 1 << '\n';
  return {"domain_ids.dat", text.take()};
}

/// Makes the points of a surface on the way: each once, in the order in which faces use them.
class Surface {
 public:
  explicit Surface(const CellMesh& mesh) : mesh_(mesh), point_of_(mesh.points.size(), -1) {}

  void add(const LocalFace& face, int patch) {
    std::array<int, 4> points = cell_face(mesh_, face.cell, face.local);
    for (int& v : points) v = point(v);
    data_.polygons.add(points);
    elements_.push_back(face.cell + 1);
    faces_.push_back(patch + 1);
  }

  std::string bytes() && {
    data_.point_arrays.push_back({"GlobalNodeID", 1, std::move(nodes_)});
    data_.cell_arrays.push_back({"GlobalElementID", 1, std::move(elements_)});
    data_.cell_arrays.push_back({"ModelFaceID", 1, std::move(faces_)});
    return vtp_bytes(data_);
  }

 private:
  int point(int vertex) {
    if (point_of_[vertex] < 0) {
      point_of_[vertex] = static_cast<int>(data_.points.size());
      data_.points.push_back(mesh_.points[vertex]);
      nodes_.push_back(vertex + 1);
    }
    return point_of_[vertex];
  }

  const CellMesh& mesh_;
  std::vector<int> point_of_;  ///< #V place of each vertex in `data_`, or -1
  PolyData data_;
  std::vector<int> nodes_, elements_, faces_;
};

/// The faces of the given patches as one surface.
std::string surface_bytes(const CellMesh& mesh, const std::vector<std::vector<LocalFace>>& faces,
                          const std::vector<int>& patches) {
  Surface surface(mesh);
  for (const int patch : patches)
    for (const LocalFace& face : faces[patch]) surface.add(face, patch);
  return std::move(surface).bytes();
}

const std::string& checked_file_name(const std::string& name) {
  if (name.empty() || name[0] == '.' || name.find('/') != std::string::npos)
    throw Error(ExitCode::internal,
                "cannot export to svMultiPhysics: the patch '" + name + "' is no name of a file");
  return name;
}

std::vector<OutputFile> surface_files(const CellMesh& mesh) {
  const CellFaceValues neighbours = neighbours_of_cells(mesh);
  const auto faces = faces_of_patches(mesh, neighbours);
  std::vector<OutputFile> files;
  std::vector<int> all, walls;
  for (int p = 0; p < static_cast<int>(faces.size()); ++p) {
    if (faces[p].empty()) continue;  // svMultiPhysics refuses surfaces without points
    all.push_back(p);
    if (mesh.patches[p].is_wall) walls.push_back(p);
    files.push_back({"mesh-surfaces/" + checked_file_name(mesh.patches[p].name) + ".vtp",
                     surface_bytes(mesh, faces, {p})});
  }
  for (std::size_t z = 0; z < mesh.face_zones.size(); ++z) {
    const CellPatch& zone = mesh.face_zones[z];
    Surface surface(mesh);
    for (const LocalFace& face : faces_of_zone(mesh, zone, neighbours))
      surface.add(face, static_cast<int>(faces.size() + z));
    files.push_back(
        {"mesh-surfaces/" + checked_file_name(zone.name) + ".vtp", std::move(surface).bytes()});
  }
  files.push_back({"mesh-complete.exterior.vtp", surface_bytes(mesh, faces, all)});
  if (!walls.empty()) files.push_back({"walls_combined.vtp", surface_bytes(mesh, faces, walls)});
  return files;
}

}  // namespace

void write_svmultiphysics(const std::filesystem::path& folder, const HexMesh& mesh) {
  std::vector<OutputFile> files = surface_files(mesh);
  files.push_back(domains_file(mesh));
  files.push_back(volume_file(mesh));
  write_output_files(folder, files);
}

}  // namespace hexwall
