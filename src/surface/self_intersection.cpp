#include "surface/self_intersection.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include "surface/separation.h"

namespace hexwall {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Pair = std::pair<int, int>;

/// Finds the pairs of triangles that meet, among those whose boxes do.
class Finder {
 public:
  explicit Finder(const TriangleSurface& surface) : surface_(surface), separation_(surface.points) {
    points_.reserve(surface.points.size());
    for (const Vec3& p : surface.points) points_.emplace_back(p.x(), p.y(), p.z());
  }

  std::vector<Pair> run(const std::vector<int>& among) const {
    std::vector<Pair> found;
    std::vector<int> faces;
    std::vector<Eigen::AlignedBox3d> boxes;
    for (const int f : among) {
      const auto& [a, b, c] = surface_.triangles[f];
      if (CGAL::collinear(points_[a], points_[b], points_[c])) {
        found.emplace_back(f, f);
        continue;
      }
      faces.push_back(f);
      boxes.emplace_back(surface_.points[a]);
      boxes.back().extend(surface_.points[b]).extend(surface_.points[c]);
    }
    for (const auto& [f, g] : box_pairs(boxes, [&](int a, int b) {
           const auto& s = surface_.triangles[faces[a]];
           const auto& t = surface_.triangles[faces[b]];
           return !separation_.is_certain(s, t) && meet(s, t);
         })) {
      found.emplace_back(faces[f], faces[g]);
    }
    std::sort(found.begin(), found.end());
    return found;
  }

 private:
  // Anywhere but in common vertices and edges.
  bool meet(std::array<int, 3> s, std::array<int, 3> t) const {
    // Common vertices come first, in the same order.
    int shared = 0;
    for (int i = 0; i < 3; ++i) {
      const auto other = std::find(t.begin() + shared, t.end(), s[i]);
      if (other == t.end()) continue;
      std::iter_swap(t.begin() + shared, other);
      std::swap(s[shared], s[i]);
      ++shared;
    }
    if (shared == 0) return CGAL::do_intersect(triangle(s), triangle(t));
    if (shared == 1) {
      return CGAL::do_intersect(triangle(s), opposite_edge(t)) ||
             CGAL::do_intersect(triangle(t), opposite_edge(s));
    }
    if (shared == 3) return true;
    // Folded onto each other at their common edge.
    const Point& a = points_[s[0]];
    const Point& b = points_[s[1]];
    const Point& c = points_[s[2]];
    const Point& d = points_[t[2]];
    return CGAL::coplanar(a, b, c, d) && CGAL::coplanar_orientation(a, b, c, d) == CGAL::POSITIVE;
  }

  Kernel::Triangle_3 triangle(const std::array<int, 3>& t) const {
    return {points_[t[0]], points_[t[1]], points_[t[2]]};
  }
  Kernel::Segment_3 opposite_edge(const std::array<int, 3>& t) const {
    return {points_[t[1]], points_[t[2]]};
  }

  const TriangleSurface& surface_;
  Separation separation_;
  std::vector<Point> points_;
};

}  // namespace

std::vector<std::pair<int, int>> self_intersections(const TriangleSurface& surface) {
  std::vector<int> all(surface.triangles.size());
  std::iota(all.begin(), all.end(), 0);
  return self_intersections(surface, all);
}

std::vector<std::pair<int, int>> self_intersections(const TriangleSurface& surface,
                                                    const std::vector<int>& triangles) {
  return Finder(surface).run(triangles);
}

}  // namespace hexwall
