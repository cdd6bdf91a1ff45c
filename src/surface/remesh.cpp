#include "surface/remesh.h"

#include <vector>

#include <CGAL/Polygon_mesh_processing/remesh.h>

#include "surface/cgal_mesh.h"

namespace hexwall {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;

constexpr int rounds = 5;  // worst angle and vertex count settle after 3 or 4

// Remeshing splits interior edges longer than this multiple of the target; with longer boundary
// edges, which it must not touch, it need not end.
constexpr double greatest_edge = 4.0 / 3.0;

}  // namespace

TriangleSurface remesh(const TriangleSurface& surface, double edge) {
  cgal::Mesh mesh = cgal::mesh_of(surface);
  std::vector<cgal::Mesh::Edge_index> boundary;
  for (const auto e : mesh.edges()) {
    if (mesh.is_border(e)) boundary.push_back(e);
  }
  pmp::split_long_edges(boundary, greatest_edge * edge, mesh);
  pmp::isotropic_remeshing(
      mesh.faces(), edge, mesh,
      CGAL::parameters::number_of_iterations(rounds).protect_constraints(true));
  return cgal::surface_of(mesh);
}

}  // namespace hexwall
