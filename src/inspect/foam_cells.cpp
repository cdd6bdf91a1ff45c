#include "inspect/foam_cells.h"

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "core/errors.h"

namespace hexwall {
namespace {

/// Faces of a cell, pointing out of it.
using OwnFaces = std::vector<std::vector<int>>;

std::vector<int> vertices_of(const OwnFaces& faces) {
  std::vector<int> vertices;
  for (const auto& face : faces) vertices.insert(vertices.end(), face.begin(), face.end());
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

std::optional<ElementShape> shape_of(const OwnFaces& faces, std::size_t vertices) {
  const auto count = [&](std::size_t n) {
    return std::count_if(faces.begin(), faces.end(), [&](const auto& f) { return f.size() == n; });
  };
  const auto triangles = count(3);
  const auto quads = count(4);
  if (triangles + quads != static_cast<std::ptrdiff_t>(faces.size())) return std::nullopt;
  if (triangles == 4 && quads == 0 && vertices == 4) return ElementShape::tetrahedron;
  if (triangles == 4 && quads == 1 && vertices == 5) return ElementShape::pyramid;
  if (triangles == 2 && quads == 3 && vertices == 6) return ElementShape::wedge;
  if (triangles == 0 && quads == 6 && vertices == 8) return ElementShape::hexahedron;
  return std::nullopt;
}

bool holds(const std::vector<int>& list, int v) {
  return std::find(list.begin(), list.end(), v) != list.end();
}

// The vertex beyond `base` to which an edge leads from its vertex `v`; -1 unless there is one only.
int above(const OwnFaces& faces, const std::vector<int>& base, int v) {
  int found = -1;
  for (const auto& face : faces) {
    for (std::size_t k = 0; k < face.size(); ++k) {
      if (face[k] != v) continue;
      for (const int next :
           {face[(k + 1) % face.size()], face[(k + face.size() - 1) % face.size()]}) {
        if (holds(base, next) || next == found) continue;
        if (found >= 0) return -1;
        found = next;
      }
    }
  }
  return found;
}

// The corners in VTK's order: the base as seen from within, then what is above. Empty if the faces
// don't fit together as those of the shape.
std::vector<int> ordered_corners(const OwnFaces& faces, ElementShape shape) {
  const bool has_quad_base = shape == ElementShape::pyramid || shape == ElementShape::hexahedron;
  const auto base_face = std::find_if(faces.begin(), faces.end(), [&](const auto& face) {
    return face.size() == (has_quad_base ? 4U : 3U);
  });
  std::vector<int> corners(base_face->rbegin(), base_face->rend());
  const std::vector<int> base = corners;
  for (const int v : base) {
    const int top = above(faces, base, v);
    if (top < 0) return {};
    const bool has_apex = shape == ElementShape::pyramid || shape == ElementShape::tetrahedron;
    if (!holds(corners, top)) {
      corners.push_back(top);
    } else if (!has_apex) {
      return {};
    }
  }
  if (corners.size() != static_cast<std::size_t>(corner_count(shape))) return {};
  return corners;
}

void check_range(const FaceMesh& faces, std::size_t points) {
  for (int f = 0; f < faces.size(); ++f) {
    if (faces.owner[f] < 0 || faces.neighbour[f] < -1) {
      throw ReadError(fmt::format("face {} has the owner {} and the neighbour {}", f,
                                  faces.owner[f], faces.neighbour[f]));
    }
    for (const int v : faces.face(f)) {
      if (v >= 0 && static_cast<std::size_t>(v) < points) continue;
      throw ReadError(
          fmt::format("face {} has the vertex {}, but there are {} points", f, v, points));
    }
  }
}

std::vector<OwnFaces> faces_of_cells(const FaceMesh& faces) {
  std::vector<OwnFaces> result;
  const auto of_cell = [&](int cell) -> OwnFaces& {
    // Every cell has faces, so that a cell beyond their number is an error.
    if (cell >= faces.size()) {
      throw ReadError(fmt::format("cell {} of {} faces is not possible", cell, faces.size()));
    }
    if (cell >= static_cast<int>(result.size())) result.resize(cell + 1);
    return result[cell];
  };
  for (int f = 0; f < faces.size(); ++f) {
    const auto face = faces.face(f);
    of_cell(faces.owner[f]).emplace_back(face.begin(), face.end());
    if (faces.neighbour[f] >= 0) {
      of_cell(faces.neighbour[f]).emplace_back(face.rbegin(), face.rend());
    }
  }
  return result;
}

}  // namespace

void add_cells(FaceMesh faces, AnyMesh& mesh) {
  check_range(faces, mesh.points.size());
  const std::vector<OwnFaces> of_cells = faces_of_cells(faces);
  faces.cells = static_cast<int>(of_cells.size());
  for (int cell = 0; cell < faces.cells; ++cell) {
    const OwnFaces& own = of_cells[cell];
    if (own.size() < 4) throw ReadError(fmt::format("cell {} has {} faces", cell, own.size()));
    const std::vector<int> vertices = vertices_of(own);
    const std::optional<ElementShape> shape = shape_of(own, vertices.size());
    const std::vector<int> corners = shape ? ordered_corners(own, *shape) : std::vector<int>{};
    if (corners.empty()) {
      mesh.add(ElementShape::polyhedron, vertices, cell);
    } else {
      mesh.add(*shape, corners, cell);
    }
  }
  mesh.faces = std::move(faces);
}

}  // namespace hexwall
