#include "surface/vessel_remesh.h"

#include <algorithm>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Surface_mesh.h>

namespace hexwall {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Vertex = Mesh::Vertex_index;

constexpr int rounds = 8;            // vertex count and worst angle settle after 5 or 6
constexpr int boundary_passes = 10;  // per round: spreads the vertices that a split put in between

// Accuracy of the projections, relative to the edge length: between the rounds, and in the end.
constexpr double coarse = 1e-3;
constexpr double fine = 1e-12;

Vec3 to_eigen(const Kernel::Point_3& p) {
  return {p.x(), p.y(), p.z()};
}
Kernel::Point_3 to_cgal(const Vec3& p) {
  return {p.x(), p.y(), p.z()};
}

Mesh mesh_of(const TriangleSurface& surface) {
  Mesh mesh;
  for (const Vec3& p : surface.points) mesh.add_vertex(to_cgal(p));
  for (const auto& [a, b, c] : surface.triangles) {
    mesh.add_face(Vertex(static_cast<unsigned>(a)), Vertex(static_cast<unsigned>(b)),
                  Vertex(static_cast<unsigned>(c)));
  }
  return mesh;
}

TriangleSurface surface_of(Mesh& mesh) {
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

const OpenEnd& nearest_end(const VesselField& field, const Vec3& p) {
  return *std::min_element(field.ends().begin(), field.ends().end(),
                           [&p](const OpenEnd& l, const OpenEnd& r) {
                             return (p - l.center).squaredNorm() < (p - r.center).squaredNorm();
                           });
}

struct ToField {
  const Mesh* mesh;
  const VesselField* field;
  double tolerance;
  Kernel::Point_3 operator()(Vertex v) const {
    return to_cgal(field->project(to_eigen(mesh->point(v)), tolerance));
  }
};

/// Spaces the boundary vertices evenly, each between its neighbours, on the true cut.
void smooth_boundary(Mesh& mesh, const VesselField& field) {
  std::vector<std::pair<Vertex, Vec3>> moved;
  for (const auto h : mesh.halfedges()) {
    if (!mesh.is_border(h)) continue;
    const Vec3 middle = 0.5 * (to_eigen(mesh.point(mesh.source(h))) +
                               to_eigen(mesh.point(mesh.target(mesh.next(h)))));
    const Vec3 p = 0.5 * (to_eigen(mesh.point(mesh.target(h))) + middle);
    moved.emplace_back(mesh.target(h), field.project_in_plane(p, nearest_end(field, p)));
  }
  for (const auto& [v, p] : moved) mesh.point(v) = to_cgal(p);
}

void project_interior(Mesh& mesh, const VesselField& field, double tolerance) {
  const ToField to_field{&mesh, &field, tolerance};
  for (const Vertex v : mesh.vertices()) {
    if (!mesh.is_border(v)) mesh.point(v) = to_field(v);
  }
}

}  // namespace

TriangleSurface remesh_on_field(const TriangleSurface& surface, const VesselField& field,
                                double edge) {
  Mesh mesh = mesh_of(surface);
  project_interior(mesh, field, coarse * edge);
  for (int i = 0; i < rounds; ++i) {
    pmp::isotropic_remeshing(
        mesh.faces(), edge, mesh,
        CGAL::parameters::number_of_iterations(1).number_of_relaxation_steps(3).projection_functor(
            ToField{&mesh, &field, coarse * edge}));
    for (int pass = 0; pass < boundary_passes; ++pass) smooth_boundary(mesh, field);
  }
  project_interior(mesh, field, fine * edge);
  return surface_of(mesh);
}

}  // namespace hexwall
