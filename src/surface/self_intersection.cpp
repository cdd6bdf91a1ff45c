#include "surface/self_intersection.h"

#include <algorithm>
#include <iterator>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

// The only place with this part of CGAL: it takes long and much memory to compile.
namespace hexwall {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

Mesh mesh_of(const TriangleSurface& surface) {
  Mesh mesh;
  for (const Vec3& p : surface.points) mesh.add_vertex(Kernel::Point_3(p.x(), p.y(), p.z()));
  for (const auto& [a, b, c] : surface.triangles) {
    using Vertex = Mesh::Vertex_index;
    mesh.add_face(Vertex(static_cast<unsigned>(a)), Vertex(static_cast<unsigned>(b)),
                  Vertex(static_cast<unsigned>(c)));
  }
  return mesh;
}

}  // namespace

std::vector<std::pair<int, int>> self_intersections(const TriangleSurface& surface) {
  const Mesh mesh = mesh_of(surface);
  std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>> found;
  CGAL::Polygon_mesh_processing::self_intersections(mesh, std::back_inserter(found));
  std::vector<std::pair<int, int>> pairs;
  pairs.reserve(found.size());
  for (const auto& [f, g] : found) {
    const int i = static_cast<int>(f.idx());
    const int j = static_cast<int>(g.idx());
    pairs.emplace_back(std::min(i, j), std::max(i, j));
  }
  // CGAL's order of discovery is not part of its contract.
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace hexwall
