#include "hex/cell_faces.h"

#include <algorithm>
#include <limits>
#include <string>
#include <tuple>
#include <utility>

#include "core/errors.h"
#include "core/parallel.h"

namespace hexwall {
namespace {

constexpr std::array<int, 6> no_faces{-1, -1, -1, -1, -1, -1};

using Corners = std::array<int, 4>;

constexpr std::array<Corners, 4> faces_of_tetrahedron{
    {{0, 1, 3, -1}, {1, 2, 3, -1}, {2, 0, 3, -1}, {0, 2, 1, -1}}};
constexpr std::array<Corners, 6> faces_of_hexahedron{
    {{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}}};
constexpr std::array<Corners, 5> faces_of_wedge{
    {{0, 1, 2, -1}, {3, 5, 4, -1}, {0, 3, 4, 1}, {1, 4, 5, 2}, {2, 5, 3, 0}}};
constexpr std::array<Corners, 5> faces_of_pyramid{
    {{0, 3, 2, 1}, {0, 1, 4, -1}, {1, 2, 4, -1}, {2, 3, 4, -1}, {3, 0, 4, -1}}};

[[noreturn]] void inconsistent(const std::string& what) {
  throw Error(ExitCode::internal, "inconsistent mesh: " + what);
}

/// The same polygon read from its smallest vertex on: equal for equal oriented faces.
Corners from_smallest(Corners face) {
  const auto end = face.begin() + corner_count(face);
  std::rotate(face.begin(), std::min_element(face.begin(), end), end);
  return face;
}

Corners reversed(Corners face) {
  std::reverse(face.begin(), face.begin() + corner_count(face));
  return face;
}

/// Equal for faces of the same vertices; the smallest vertex is the first.
Corners sorted(Corners face) {
  if (face[3] < 0) face[3] = std::numeric_limits<int>::max();
  std::sort(face.begin(), face.end());
  return face;
}

int face_count(const CellMesh& mesh, int cell) {
  return static_cast<int>(faces_of(mesh.shape[cell]).size());
}

int local_face(const CellMesh& mesh, const CellFace& face, const std::string& patch) {
  if (face.cell < 0 || face.cell >= mesh.cells())
    inconsistent("patch " + patch + " names cell " + std::to_string(face.cell));
  for (int i = 0; i < face_count(mesh, face.cell); ++i)
    if (from_smallest(cell_face(mesh, face.cell, i)) == from_smallest(face.vertices)) return i;
  inconsistent("patch " + patch + " lists a face that cell " + std::to_string(face.cell) +
               " does not have with this orientation");
}

void check_vertices(const CellMesh& mesh) {
  const int n = static_cast<int>(mesh.points.size());
  for (const int v : mesh.connectivity)
    if (v < 0 || v >= n) inconsistent("vertex " + std::to_string(v) + " does not exist");
}

struct KeyedFace {
  Corners key;
  LocalFace face;
};

/// The faces of all cells, grouped by their smallest vertex.
struct FacesByVertex {
  std::vector<int> begin;  ///< #V+1 start of the vertex' group in `faces`
  std::vector<KeyedFace> faces;
};

/// In each group those of the same vertices are one after the other, by cell.
FacesByVertex grouped_faces(const CellMesh& mesh) {
  FacesByVertex groups{std::vector<int>(mesh.points.size() + 1, 0), {}};
  const auto for_each = [&](const auto& visit) {
    for (int cell = 0; cell < mesh.cells(); ++cell)
      for (int i = 0; i < face_count(mesh, cell); ++i)
        visit(KeyedFace{sorted(cell_face(mesh, cell, i)), {cell, i}});
  };
  for_each([&](const KeyedFace& face) { ++groups.begin[face.key[0] + 1]; });
  for (std::size_t v = 1; v < groups.begin.size(); ++v) groups.begin[v] += groups.begin[v - 1];
  groups.faces.resize(static_cast<std::size_t>(groups.begin.back()));
  std::vector<int> next = groups.begin;
  for_each([&](const KeyedFace& face) { groups.faces[next[face.key[0]]++] = face; });
  parallel_for(mesh.points.size(), [&](std::size_t v) {
    std::sort(groups.faces.begin() + groups.begin[v], groups.faces.begin() + groups.begin[v + 1],
              [](const KeyedFace& a, const KeyedFace& b) {
                return std::tie(a.key, a.face.cell, a.face.local) <
                       std::tie(b.key, b.face.cell, b.face.local);
              });
  });
  return groups;
}

std::string cells_of(const LocalFace& a, const LocalFace& b) {
  return "cells " + std::to_string(a.cell) + " and " + std::to_string(b.cell);
}

void join(const CellMesh& mesh, const LocalFace& a, const LocalFace& b,
          CellFaceValues& neighbours) {
  if (from_smallest(cell_face(mesh, a.cell, a.local)) !=
      from_smallest(reversed(cell_face(mesh, b.cell, b.local))))
    inconsistent(cells_of(a, b) + " lie on the same side of their common face");
  neighbours[a.cell][a.local] = b.cell;
  neighbours[b.cell][b.local] = a.cell;
}

void check_boundary(const CellMesh& mesh, const CellFaceValues& neighbours,
                    const CellFaceValues& patch_of) {
  for (int cell = 0; cell < mesh.cells(); ++cell)
    for (int i = 0; i < face_count(mesh, cell); ++i) {
      const bool on_boundary = neighbours[cell][i] < 0;
      if (on_boundary == (patch_of[cell][i] >= 0)) continue;
      inconsistent("face " + std::to_string(i) + " of cell " + std::to_string(cell) +
                   (on_boundary ? " is on the boundary but in no patch"
                                : " is in a patch but not on the boundary"));
    }
}

/// Neighbours with a higher number, in ascending order: upper-triangular order.
void append_internal_faces(const CellMesh& mesh, const CellFaceValues& neighbours,
                           SharedFaces& result) {
  for (int cell = 0; cell < mesh.cells(); ++cell) {
    const auto first = static_cast<std::ptrdiff_t>(result.faces.size());
    for (int i = 0; i < face_count(mesh, cell); ++i) {
      const int other = neighbours[cell][i];
      if (other > cell) result.faces.push_back({cell_face(mesh, cell, i), cell, i, other});
    }
    std::sort(result.faces.begin() + first, result.faces.end(),
              [](const SharedFace& a, const SharedFace& b) {
                return std::pair(a.neighbour, a.local) < std::pair(b.neighbour, b.local);
              });
  }
  result.internal = static_cast<int>(result.faces.size());
}

/// Takes over the cells of one region, with numbers of their own.
class RegionCutter {
 public:
  RegionCutter(const CellMesh& mesh, int region)
      : mesh_(mesh),
        region_(region),
        cell_(static_cast<std::size_t>(mesh.cells()), -1),
        point_(mesh.points.size(), -1) {}

  CellMesh run() {
    for (const int cell : mesh_.regions[region_].cells) mark(cell);
    number_points();
    for (const int cell : mesh_.regions[region_].cells) add(cell);
    for (const CellPatch& patch : mesh_.patches) {
      CellPatch part{patch.name, patch.is_wall, {}};
      for (const CellFace& face : patch.faces)
        if (cell_[face.cell] >= 0) part.faces.push_back(renumbered(face.vertices, face.cell));
      if (!part.faces.empty()) result_.patches.push_back(std::move(part));
    }
    for (const CellPatch& zone : mesh_.face_zones) add_interface(zone);
    result_.zones = parts_of(mesh_.zones);
    result_.regions = parts_of(mesh_.regions);
    return std::move(result_);
  }

 private:
  void mark(int cell) {
    cell_[cell] = cells_++;
    for (const int v : mesh_.corners(cell)) point_[v] = 0;
  }

  void number_points() {
    for (std::size_t v = 0; v < point_.size(); ++v) {
      if (point_[v] < 0) continue;
      point_[v] = static_cast<int>(result_.points.size());
      result_.points.push_back(mesh_.points[v]);
    }
  }

  void add(int cell) {
    std::vector<int> corners;
    for (const int v : mesh_.corners(cell)) corners.push_back(point_[v]);
    result_.add(mesh_.shape[cell], corners);
  }

  CellFace renumbered(Corners vertices, int cell) const {
    for (int k = 0; k < corner_count(vertices); ++k) vertices[k] = point_[vertices[k]];
    return {vertices, cell_[cell]};
  }

  // The faces of a zone are those of cells of the first region, which the second has reversed.
  void add_interface(const CellPatch& zone) {
    CellPatch patch{
        mesh_.regions[region_].name + "_to_" + mesh_.regions[1 - region_].name, true, {}};
    if (region_ == 0) {
      for (const CellFace& face : zone.faces)
        patch.faces.push_back(renumbered(face.vertices, face.cell));
    } else {
      const std::vector<int> behind = cells_behind(zone);
      for (std::size_t i = 0; i < behind.size(); ++i)
        patch.faces.push_back(renumbered(reversed(zone.faces[i].vertices), behind[i]));
    }
    result_.patches.push_back(std::move(patch));
  }

  std::vector<int> cells_behind(const CellPatch& zone) const {
    const CellFaceValues neighbours = neighbours_of_cells(mesh_);
    std::vector<int> cells;
    for (const LocalFace& face : faces_of_zone(mesh_, zone, neighbours))
      cells.push_back(neighbours[face.cell][face.local]);
    return cells;
  }

  std::vector<CellGroup> parts_of(const std::vector<CellGroup>& groups) const {
    std::vector<CellGroup> parts;
    for (const CellGroup& group : groups) {
      CellGroup part{group.name, {}};
      for (const int cell : group.cells)
        if (cell_[cell] >= 0) part.cells.push_back(cell_[cell]);
      if (!part.cells.empty()) parts.push_back(std::move(part));
    }
    return parts;
  }

  const CellMesh& mesh_;
  int region_;
  int cells_ = 0;
  std::vector<int> cell_, point_;  // new numbers, -1 outside the region
  CellMesh result_;
};

}  // namespace

std::span<const std::array<int, 4>> faces_of(CellShape shape) {
  switch (shape) {
    case CellShape::tetrahedron:
      return faces_of_tetrahedron;
    case CellShape::hexahedron:
      return faces_of_hexahedron;
    case CellShape::wedge:
      return faces_of_wedge;
    default:
      return faces_of_pyramid;
  }
}

std::array<int, 4> cell_face(const CellMesh& mesh, int cell, int face) {
  const Corners& local = faces_of(mesh.shape[cell])[face];
  const int* corners = mesh.connectivity.data() + mesh.offset[cell];
  return {corners[local[0]], corners[local[1]], corners[local[2]],
          local[3] < 0 ? -1 : corners[local[3]]};
}

CellFaceValues patch_of_faces(const CellMesh& mesh) {
  CellFaceValues patches(mesh.shape.size(), no_faces);
  for (std::size_t p = 0; p < mesh.patches.size(); ++p) {
    const std::string& name = mesh.patches[p].name;
    for (const CellFace& face : mesh.patches[p].faces) {
      int& patch = patches[face.cell][local_face(mesh, face, name)];
      if (patch >= 0) inconsistent("a face of patch " + name + " is listed twice");
      patch = static_cast<int>(p);
    }
  }
  return patches;
}

CellFaceValues neighbours_of_cells(const CellMesh& mesh) {
  check_vertices(mesh);
  CellFaceValues neighbours(mesh.shape.size(), no_faces);
  const std::vector<KeyedFace> faces = grouped_faces(mesh).faces;
  for (std::size_t i = 0; i + 2 < faces.size(); ++i)
    if (faces[i].key == faces[i + 2].key)
      inconsistent(cells_of(faces[i].face, faces[i + 1].face) + " share a face with a third cell");
  for (std::size_t i = 0; i + 1 < faces.size(); ++i)
    if (faces[i].key == faces[i + 1].key) join(mesh, faces[i].face, faces[i + 1].face, neighbours);
  return neighbours;
}

std::vector<std::vector<LocalFace>> faces_of_patches(const CellMesh& mesh,
                                                     const CellFaceValues& neighbours) {
  const CellFaceValues patch_of = patch_of_faces(mesh);
  check_boundary(mesh, neighbours, patch_of);
  std::vector<std::vector<LocalFace>> faces(mesh.patches.size());
  for (int cell = 0; cell < mesh.cells(); ++cell)
    for (int i = 0; i < face_count(mesh, cell); ++i)
      if (const int patch = patch_of[cell][i]; patch >= 0) faces[patch].push_back({cell, i});
  return faces;
}

std::vector<LocalFace> faces_of_zone(const CellMesh& mesh, const CellPatch& zone,
                                     const CellFaceValues& neighbours) {
  std::vector<LocalFace> faces;
  faces.reserve(zone.faces.size());
  for (const CellFace& face : zone.faces) {
    const int local = local_face(mesh, face, zone.name);
    if (neighbours[face.cell][local] < 0)
      inconsistent("a face of zone " + zone.name + " is on the boundary");
    faces.push_back({face.cell, local});
  }
  return faces;
}

std::vector<int> group_of_cells(const CellMesh& mesh, const std::vector<CellGroup>& groups) {
  std::vector<int> group_of(mesh.shape.size(), -1);
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (const int cell : groups[g].cells) {
      if (cell < 0 || cell >= mesh.cells() || group_of[cell] >= 0)
        inconsistent("zone " + groups[g].name + " lists cell " + std::to_string(cell) +
                     ", which does not exist or is in a zone already");
      group_of[cell] = static_cast<int>(g);
    }
  if (std::find(group_of.begin(), group_of.end(), -1) != group_of.end())
    inconsistent("a cell is in no zone");
  return group_of;
}

SharedFaces shared_faces(const CellMesh& mesh) {
  const CellFaceValues neighbours = neighbours_of_cells(mesh);
  SharedFaces result;
  result.faces.reserve(3 * mesh.shape.size());
  append_internal_faces(mesh, neighbours, result);
  for (const std::vector<LocalFace>& faces : faces_of_patches(mesh, neighbours))
    for (const auto& [cell, local] : faces)
      result.faces.push_back({cell_face(mesh, cell, local), cell, local, -1});
  return result;
}

CellMesh region_mesh(const CellMesh& mesh, int region) {
  return RegionCutter(mesh, region).run();
}

}  // namespace hexwall
