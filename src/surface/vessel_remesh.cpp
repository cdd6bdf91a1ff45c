#include "surface/vessel_remesh.h"

#include <algorithm>
#include <vector>

#include <CGAL/Polygon_mesh_processing/remesh.h>

#include "core/cancel.h"
#include "surface/cgal_mesh.h"

namespace hexwall {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;

using cgal::Kernel;
using cgal::Mesh;
using cgal::to_cgal;
using cgal::to_eigen;
using cgal::Vertex;

constexpr int rounds = 8;            // vertex count and worst angle settle after 5 or 6
constexpr int boundary_passes = 10;  // per round: spreads the vertices that a split put in between

// Accuracy of the projections, relative to the edge length: between the rounds, and in the end.
constexpr double coarse = 1e-3;
constexpr double fine = 1e-12;

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
    throw_if_cancelled();
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
  Mesh mesh = cgal::mesh_of(surface);
  project_interior(mesh, field, coarse * edge);
  for (int i = 0; i < rounds; ++i) {
    pmp::isotropic_remeshing(
        mesh.faces(), edge, mesh,
        CGAL::parameters::number_of_iterations(1).number_of_relaxation_steps(3).projection_functor(
            ToField{&mesh, &field, coarse * edge}));
    for (int pass = 0; pass < boundary_passes; ++pass) smooth_boundary(mesh, field);
  }
  project_interior(mesh, field, fine * edge);
  return cgal::surface_of(mesh);
}

}  // namespace hexwall
