#include "surface/self_intersection.h"

#include <algorithm>
#include <iterator>

#include <CGAL/Polygon_mesh_processing/self_intersections.h>

#include "surface/cgal_mesh.h"

namespace hexwall {

std::vector<std::pair<int, int>> self_intersections(const TriangleSurface& surface) {
  const cgal::Mesh mesh = cgal::mesh_of(surface);
  std::vector<std::pair<cgal::Mesh::Face_index, cgal::Mesh::Face_index>> found;
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
