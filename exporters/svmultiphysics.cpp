#include "exporters/svmultiphysics.h"

#include <array>
#include <memory>
#include <numeric>
#include <ostream>
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
  OutputFile file{"mesh-complete.mesh.vtu", ""};
  file.source = [&mesh](std::ostream& stream) {
    write_vtu(stream, mesh,
              {{"layer", 1, mesh.layer},
               {"quad", 1, mesh.quad},
               {"GlobalElementID", 1, numbers(mesh.shape.size())},
               {"ModelRegionID", 1, from_one(group_of_cells(mesh, mesh.zones))}},
              {{"GlobalNodeID", 1, numbers(mesh.points.size())}});
  };
  return file;
}

OutputFile domains_file(const CellMesh& mesh) {
  Text text(4 * mesh.shape.size());
  for (const int zone : group_of_cells(mesh, mesh.zones)) text << zone + 1 << '\n';
  return {"domain_ids.dat", text.take()};
}

/// The faces of a patch or a face zone.
struct Part {
  int id;  ///< from 1
  std::vector<LocalFace> faces;
};

/// Makes the points of a surface on the way: each once, in the order in which faces use them.
class Surface {
 public:
  explicit Surface(const CellMesh& mesh) : mesh_(mesh), point_of_(mesh.points.size(), -1) {}

  void add(const Part& part) {
    for (const auto& [cell, local] : part.faces) {
      std::array<int, 4> points = cell_face(mesh_, cell, local);
      for (int& v : points) v = point(v);
      data_.polygons.add(points);
      elements_.push_back(cell + 1);
      parts_.push_back(part.id);
    }
  }

  PolyData data() && {
    data_.point_arrays.push_back({"GlobalNodeID", 1, std::move(nodes_)});
    data_.cell_arrays.push_back({"GlobalElementID", 1, std::move(elements_)});
    data_.cell_arrays.push_back({"ModelFaceID", 1, std::move(parts_)});
    return std::move(data_);
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
  std::vector<int> nodes_, elements_, parts_;
};

using Parts = std::vector<std::shared_ptr<const Part>>;

/// The given parts as one surface, which is made when the file is written.
OutputFile surface_file(const std::string& path, const CellMesh& mesh, const Parts& parts) {
  OutputFile file{path, ""};
  file.source = [&mesh, parts](std::ostream& stream) {
    Surface surface(mesh);
    for (const auto& part : parts) surface.add(*part);
    write_vtp(stream, std::move(surface).data());
  };
  return file;
}

std::string path_of(const std::string& patch) {
  if (patch.empty() || patch[0] == '.' || patch.find('/') != std::string::npos)
    throw Error(ExitCode::internal,
                "cannot export to svMultiPhysics: the patch '" + patch + "' is no name of a file");
  return "mesh-surfaces/" + patch + ".vtp";
}

std::vector<OutputFile> surface_files(const CellMesh& mesh) {
  const CellFaceValues neighbours = neighbours_of_cells(mesh);
  std::vector<std::vector<LocalFace>> faces = faces_of_patches(mesh, neighbours);
  std::vector<OutputFile> files;
  Parts all, walls;
  int id = 0;
  for (const CellPatch& patch : mesh.patches) {
    const auto part = std::make_shared<const Part>(Part{id + 1, std::move(faces[id])});
    ++id;
    if (part->faces.empty()) continue;  // svMultiPhysics refuses surfaces without points
    all.push_back(part);
    if (patch.is_wall) walls.push_back(part);
    files.push_back(surface_file(path_of(patch.name), mesh, {part}));
  }
  for (const CellPatch& zone : mesh.face_zones) {
    const Part part{++id, faces_of_zone(mesh, zone, neighbours)};
    files.push_back(surface_file(path_of(zone.name), mesh, {std::make_shared<const Part>(part)}));
  }
  files.push_back(surface_file("mesh-complete.exterior.vtp", mesh, all));
  if (!walls.empty()) files.push_back(surface_file("walls_combined.vtp", mesh, walls));
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
