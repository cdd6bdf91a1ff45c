#include "inspect/any_mesh.h"

#include <algorithm>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "core/errors.h"

namespace hexwall {
namespace {

constexpr std::array<std::string_view, element_shapes> names{
    "triangle", "quad", "polygon", "tetrahedron", "pyramid", "wedge", "hexahedron", "polyhedron"};

constexpr std::array<int, element_shapes> corner_counts{3, 4, 0, 4, 5, 6, 8, 0};

constexpr std::array<ShapeFace, 4> tetrahedron{
    {{0, 2, 1, -1}, {0, 1, 3, -1}, {1, 2, 3, -1}, {2, 0, 3, -1}}};
constexpr std::array<ShapeFace, 5> pyramid{
    {{0, 3, 2, 1}, {0, 1, 4, -1}, {1, 2, 4, -1}, {2, 3, 4, -1}, {3, 0, 4, -1}}};
// The first triangle looks towards the second one, as in the shape functions of all solvers.
constexpr std::array<ShapeFace, 5> wedge{
    {{0, 2, 1, -1}, {3, 4, 5, -1}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}};
constexpr std::array<ShapeFace, 6> hexahedron{
    {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};

}  // namespace

std::string_view name(ElementShape shape) {
  return names[static_cast<std::size_t>(shape)];
}

bool is_volume(ElementShape shape) {
  return shape >= ElementShape::tetrahedron;
}

int corner_count(ElementShape shape) {
  return corner_counts[static_cast<std::size_t>(shape)];
}

std::span<const ShapeFace> faces_of(ElementShape shape) {
  switch (shape) {
    case ElementShape::tetrahedron:
      return tetrahedron;
    case ElementShape::pyramid:
      return pyramid;
    case ElementShape::wedge:
      return wedge;
    case ElementShape::hexahedron:
      return hexahedron;
    default:
      return {};
  }
}

void FaceMesh::add(std::span<const int> face, int own, int next) {
  vertices.insert(vertices.end(), face.begin(), face.end());
  first.push_back(static_cast<int>(vertices.size()));
  owner.push_back(own);
  neighbour.push_back(next);
}

void AnyMesh::add(ElementShape kind, std::span<const int> vertices, std::int64_t number) {
  shape.push_back(kind);
  corners.insert(corners.end(), vertices.begin(), vertices.end());
  first.push_back(static_cast<int>(corners.size()));
  label.push_back(number);
}

Vec3 center_of(const AnyMesh& mesh, int element) {
  Vec3 sum = Vec3::Zero();
  const auto corners = mesh.element(element);
  for (const int v : corners) sum += mesh.points[v];
  return sum / static_cast<double>(corners.size());
}

double volume_of(const AnyMesh& mesh, int element) {
  const Vec3 origin = center_of(mesh, element);
  const auto corners = mesh.element(element);
  double sum = 0.0;
  for (const ShapeFace& face : faces_of(mesh.shape[element])) {
    const int n = face[3] < 0 ? 3 : 4;
    Vec3 center = Vec3::Zero();
    for (int k = 0; k < n; ++k) center += (mesh.points[corners[face[k]]] - origin) / n;
    for (int k = 0; k < n; ++k) {
      const Vec3 a = mesh.points[corners[face[k]]] - origin;
      const Vec3 b = mesh.points[corners[face[(k + 1) % n]]] - origin;
      sum += a.cross(b).dot(center) / 6.0;
    }
  }
  return sum;
}

void orient_wedges(AnyMesh& mesh) {
  double sum = 0.0;
  for (int e = 0; e < mesh.size(); ++e) {
    if (mesh.shape[e] == ElementShape::wedge) sum += volume_of(mesh, e);
  }
  if (sum >= 0.0) return;
  for (int e = 0; e < mesh.size(); ++e) {
    if (mesh.shape[e] != ElementShape::wedge) continue;
    int* corners = mesh.corners.data() + mesh.first[e];
    std::swap_ranges(corners, corners + 3, corners + 3);
  }
  mesh.notes.emplace_back("the wedges were turned around: the file has the other order of corners");
}

void check_mesh_is_sound(const AnyMesh& mesh) {
  if (mesh.size() == 0) throw ReadError("there are no cells, and no triangles or quads");
  const auto points = static_cast<int>(mesh.points.size());
  for (int e = 0; e < mesh.size(); ++e) {
    for (const int v : mesh.element(e)) {
      if (v < 0 || v >= points) {
        throw ReadError(
            fmt::format("{} {} refers to a point that is not in the file, which has {} points",
                        mesh.label_word, mesh.label[e], points));
      }
      if (mesh.points[v].allFinite()) continue;
      throw ReadError(fmt::format("a corner of {} {} has a coordinate that is not finite",
                                  mesh.label_word, mesh.label[e]));
    }
  }
}

}  // namespace hexwall
