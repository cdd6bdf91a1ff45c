#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include "surface/triangle_surface.h"

/// Between our surfaces and CGAL's. Costly to include: for the few files that call CGAL only.
namespace hexwall::cgal {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Vertex = Mesh::Vertex_index;

inline Vec3 to_eigen(const Kernel::Point_3& p) {
  return {p.x(), p.y(), p.z()};
}

inline Kernel::Point_3 to_cgal(const Vec3& p) {
  return {p.x(), p.y(), p.z()};
}

/// Vertices and triangles keep their numbers. \pre oriented manifold.
inline Mesh mesh_of(const TriangleSurface& surface) {
  Mesh mesh;
  for (const Vec3& p : surface.points) mesh.add_vertex(to_cgal(p));
  for (const auto& [a, b, c] : surface.triangles) {
    mesh.add_face(Vertex(static_cast<unsigned>(a)), Vertex(static_cast<unsigned>(b)),
                  Vertex(static_cast<unsigned>(c)));
  }
  return mesh;
}

/// Without what was removed from `mesh`.
inline TriangleSurface surface_of(Mesh& mesh) {
  mesh.collect_garbage();
  TriangleSurface surface;
  for (const Vertex v : mesh.vertices()) surface.points.push_back(to_eigen(mesh.point(v)));
  for (const auto f : mesh.faces()) {
    std::array<int, 3> triangle{};
    int k = 0;
    for (const Vertex v : mesh.vertices_around_face(mesh.halfedge(f))) {
      triangle[k++] = static_cast<int>(v.idx());
    }
    surface.triangles.push_back(triangle);
  }
  return surface;
}

}  // namespace hexwall::cgal
