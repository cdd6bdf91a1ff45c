#include "surface/self_intersection.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>

#include <CGAL/Bbox_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>

#include "core/parallel.h"

namespace hexwall {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Box =
    CGAL::Box_intersection_d::Box_with_info_d<double, 3, int,
                                              CGAL::Box_intersection_d::ID_FROM_BOX_ADDRESS>;
using Pair = std::pair<int, int>;

// Below as many boxes CGAL scans them instead of dividing them further: measured.
constexpr std::ptrdiff_t cutoff = 1000;
// Pairs of triangles whose boxes meet are looked at by as many at a time.
constexpr std::size_t batch = std::size_t{1} << 20;

/// Finds the pairs of triangles that meet, among those whose boxes do.
class Finder {
 public:
  explicit Finder(const TriangleSurface& surface) : triangles_(surface.triangles) {
    points_.reserve(surface.points.size());
    for (const Vec3& p : surface.points) points_.emplace_back(p.x(), p.y(), p.z());
  }

  std::vector<Pair> run(const std::vector<int>& among) {
    std::vector<Box> boxes;
    boxes.reserve(among.size());
    for (const int f : among) {
      const auto& [a, b, c] = triangles_[f];
      if (CGAL::collinear(points_[a], points_[b], points_[c])) {
        found_.emplace_back(f, f);
      } else {
        boxes.emplace_back(points_[a].bbox() + points_[b].bbox() + points_[c].bbox(), f);
      }
    }
    std::vector<const Box*> order;
    order.reserve(boxes.size());
    for (const Box& box : boxes) order.push_back(&box);
    CGAL::box_self_intersection_d(
        order.begin(), order.end(),
        [this](const Box* a, const Box* b) {
          candidates_.emplace_back(std::min(a->info(), b->info()), std::max(a->info(), b->info()));
          if (candidates_.size() == batch) look_at_candidates();
        },
        cutoff);
    look_at_candidates();
    std::sort(found_.begin(), found_.end());
    return std::move(found_);
  }

 private:
  void look_at_candidates() {
    meets_.resize(candidates_.size());
    parallel_for(candidates_.size(), [this](std::size_t i) {
      const auto& [f, g] = candidates_[i];
      meets_[i] = meet(triangles_[f], triangles_[g]) ? 1 : 0;
    });
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
      if (meets_[i] != 0) found_.push_back(candidates_[i]);
    }
    candidates_.clear();
  }

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

  const std::vector<std::array<int, 3>>& triangles_;
  std::vector<Point> points_;
  std::vector<Pair> candidates_, found_;
  std::vector<char> meets_;
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
