#include "surface/surface_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

namespace hexwall {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

using Coordinates = std::array<std::array<double, 3>, 3>;

Kernel::Point_3 to_cgal(const Vec3& p) {
  return {p.x(), p.y(), p.z()};
}

/// Corners in an order that does not depend on the numbering.
Coordinates corners_of(const TriangleSurface& surface, int f) {
  Coordinates corners{};
  for (int k = 0; k < 3; ++k) {
    const Vec3& p = surface.points[surface.triangles[f][k]];
    corners[k] = {p.x(), p.y(), p.z()};
  }
  std::sort(corners.begin(), corners.end());
  return corners;
}

std::vector<Coordinates> sorted_triangles(const TriangleSurface& surface) {
  std::vector<Coordinates> result;
  result.reserve(surface.triangles.size());
  for (std::size_t f = 0; f < surface.triangles.size(); ++f) {
    result.push_back(corners_of(surface, static_cast<int>(f)));
  }
  std::sort(result.begin(), result.end());
  return result;
}

std::vector<Vec3> samples(const TriangleSurface& surface, const std::vector<Coordinates>& common) {
  std::vector<Vec3> result;
  for (int f = 0; f < static_cast<int>(surface.triangles.size()); ++f) {
    if (std::binary_search(common.begin(), common.end(), corners_of(surface, f))) continue;
    for (const int v : surface.triangles[f]) result.push_back(surface.points[v]);
    result.push_back(centroid(surface, f));
  }
  return result;
}

double greatest_distance(const std::vector<Vec3>& points, const TriangleSurface& surface) {
  if (points.empty()) return 0.0;
  Triangles triangles;
  for (int f = 0; f < static_cast<int>(surface.triangles.size()); ++f) {
    if (!has_area(surface, f)) continue;  // no plane to project on; its neighbours have its edges
    const auto& [a, b, c] = surface.triangles[f];
    triangles.emplace_back(to_cgal(surface.points[a]), to_cgal(surface.points[b]),
                           to_cgal(surface.points[c]));
  }
  Tree tree(triangles.cbegin(), triangles.cend());
  tree.accelerate_distance_queries();
  double squared = 0.0;
  for (const Vec3& p : points) squared = std::max(squared, tree.squared_distance(to_cgal(p)));
  return std::sqrt(squared);
}

}  // namespace

double surface_distance(const TriangleSurface& a, const TriangleSurface& b) {
  const std::vector<Coordinates> of_a = sorted_triangles(a);
  const std::vector<Coordinates> of_b = sorted_triangles(b);
  return std::max(greatest_distance(samples(a, of_b), b), greatest_distance(samples(b, of_a), a));
}

}  // namespace hexwall
