#include "surface/self_intersection.h"

#include <algorithm>
#include <iterator>
#include <numeric>

#include <CGAL/Polygon_mesh_processing/self_intersections.h>

#include "surface/cgal_mesh.h"

namespace hexwall {
namespace {

using Face = cgal::Mesh::Face_index;

std::vector<std::pair<int, int>> sorted_numbers(const std::vector<std::pair<Face, Face>>& found) {
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

}  // namespace

std::vector<std::pair<int, int>> self_intersections(const TriangleSurface& surface) {
  std::vector<int> all(surface.triangles.size());
  std::iota(all.begin(), all.end(), 0);
  return self_intersections(surface, all);
}

std::vector<std::pair<int, int>> self_intersections(const TriangleSurface& surface,
                                                    const std::vector<int>& triangles) {
  const cgal::Mesh mesh = cgal::mesh_of(surface);
  std::vector<Face> faces;
  faces.reserve(triangles.size());
  for (const int f : triangles) faces.emplace_back(static_cast<unsigned>(f));
  std::vector<std::pair<Face, Face>> found;
  CGAL::Polygon_mesh_processing::self_intersections(faces, mesh, std::back_inserter(found));
  return sorted_numbers(found);
}

}  // namespace hexwall
