#include "inspect/face_mesh.h"

#include <algorithm>
#include <array>
#include <tuple>

#include <fmt/format.h>

#include "core/errors.h"

namespace hexwall {
namespace {

/// A face of a cell. Faces of equal keys have the same vertices: the three lowest and their number
/// tell faces of sound meshes apart.
struct Side {
  std::array<int, 4> key;
  int cell;
  int begin, end;  ///< its vertices in `Sides::vertices`
};

struct Sides {
  std::vector<int> vertices;
  std::vector<Side> sides;

  void add(std::span<const int> face, int cell) {
    const auto begin = static_cast<int>(vertices.size());
    vertices.insert(vertices.end(), face.begin(), face.end());
    std::vector<int> sorted(face.begin(), face.end());
    std::partial_sort(sorted.begin(), sorted.begin() + 3, sorted.end());
    const auto count = static_cast<int>(face.size());
    sides.push_back({{sorted[0], sorted[1], sorted[2], count}, cell, begin, begin + count});
  }
};

void add_sides(const AnyMesh& mesh, int element, int cell, Sides& sides) {
  if (mesh.shape[element] == ElementShape::polyhedron) {
    for_faces_of_stream(mesh.polyhedron_faces.at(element),
                        [&](std::span<const int> face) { sides.add(face, cell); });
    return;
  }
  const auto corners = mesh.element(element);
  for (const ShapeFace& face : faces_of(mesh.shape[element])) {
    std::array<int, 4> vertices{};
    const std::size_t n = face[3] < 0 ? 3 : 4;
    for (std::size_t k = 0; k < n; ++k) vertices[k] = corners[face[k]];
    sides.add(std::span(vertices).first(n), cell);
  }
}

}  // namespace

CellFaces cell_faces(const AnyMesh& mesh) {
  CellFaces result;
  for (int e = 0; e < mesh.size(); ++e) {
    if (is_volume(mesh.shape[e])) result.element.push_back(e);
  }
  const auto cells = static_cast<int>(result.element.size());
  if (mesh.faces) {
    result.faces = *mesh.faces;
    return result;
  }
  Sides all;
  for (int c = 0; c < cells; ++c) add_sides(mesh, result.element[c], c, all);
  std::sort(all.sides.begin(), all.sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.key, a.cell) < std::tie(b.key, b.cell);
  });
  result.faces.cells = cells;
  for (std::size_t i = 0; i < all.sides.size();) {
    const Side& side = all.sides[i];
    const bool is_shared = i + 1 < all.sides.size() && all.sides[i + 1].key == side.key;
    const bool is_extra = i > 0 && all.sides[i - 1].key == side.key;
    if (is_extra) ++result.overfull;
    const std::span<const int> face(all.vertices.data() + side.begin,
                                    all.vertices.data() + side.end);
    result.faces.add(face, side.cell, is_shared ? all.sides[i + 1].cell : -1);
    i += is_shared ? 2 : 1;
  }
  return result;
}

std::vector<int> vertices_of_stream(std::span<const int> stream, std::int64_t label) {
  std::vector<int> vertices;
  const bool is_sound = for_faces_of_stream(stream, [&](std::span<const int> face) {
    vertices.insert(vertices.end(), face.begin(), face.end());
  });
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  if (!is_sound || vertices.size() < 4) {
    throw ReadError(fmt::format("the faces of cell {}, a polyhedron, are damaged", label));
  }
  return vertices;
}

void offset_stream(std::vector<int>& stream, int offset) {
  std::vector<int> moved;
  if (!stream.empty()) moved.push_back(stream[0]);
  const bool is_sound = for_faces_of_stream(stream, [&](std::span<const int> face) {
    moved.push_back(static_cast<int>(face.size()));
    for (const int v : face) moved.push_back(v < 0 ? -1 : v + offset);
  });
  if (is_sound) stream = std::move(moved);
}

}  // namespace hexwall
