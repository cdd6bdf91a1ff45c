#include "surface/clip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "core/errors.h"
#include "surface/loop_shape.h"
#include "surface/projector.h"
#include "surface/regions.h"

namespace hexwall {
namespace {

// Vertices nearer to the cut than this, in terms of the cut edge's length, slide onto it. Where
// that would entangle the triangles around, only vertices that lie on the plane up to rounding do.
constexpr double sliding_distance = 1.0 / 6.0;
constexpr double rounding_distance = 1e-6;
// A slide may shrink the triangles around it to this fraction of their area, but never flip them.
constexpr double least_area_left = 0.3;
// Of the section's radius: a point further off is not meant for that branch.
constexpr double farthest_point = 3.0;

[[noreturn]] void refuse(const CutPlane& plane, const std::string& reason) {
  throw GeometryError(fmt::format(
      "the cut {}at ({:.6g}, {:.6g}, {:.6g}) with the normal ({:.3g}, {:.3g}, {:.3g}) {}",
      plane.name.empty() ? "" : fmt::format("'{}' ", plane.name), plane.point.x(), plane.point.y(),
      plane.point.z(), plane.normal.x(), plane.normal.y(), plane.normal.z(), reason));
}

double height(const CutPlane& plane, const Vec3& p) {
  return (p - plane.point).dot(plane.normal);
}

// --- sections -----------------------------------------------------------------------------------

/// A curve in which the plane cuts the surface, through edges whose ends lie on different sides.
/// A vertex in the plane counts as lying above it, so that a curve never branches.
struct Section {
  std::vector<int> triangles;  ///< in the order of the curve
  std::vector<Vec3> points;    ///< where it enters them
  bool is_closed = false;
};

class SectionTracer {
 public:
  SectionTracer(const TriangleSurface& surface, const std::vector<FaceNeighbours>& neighbours,
                const CutPlane& plane)
      : surface_(surface), neighbours_(neighbours) {
    height_.reserve(surface.points.size());
    for (const Vec3& p : surface.points) height_.push_back(height(plane, p));
  }

  std::vector<Section> run() {
    std::vector<Section> sections;
    visited_.assign(surface_.triangles.size(), 0);
    for (int f = 0; f < static_cast<int>(visited_.size()); ++f) {
      if (visited_[f] != 0) continue;
      for (int k = 0; k < 3; ++k) {
        if (!is_cut(f, k) || visited_[f] != 0) continue;
        sections.push_back(trace(f, k));
      }
    }
    return sections;
  }

 private:
  bool is_cut(int f, int k) const {
    const auto& t = surface_.triangles[f];
    return (height_[t[k]] < 0.0) != (height_[t[(k + 1) % 3]] < 0.0);
  }

  Vec3 crossing(int f, int k) const {
    const int a = surface_.triangles[f][k];
    const int b = surface_.triangles[f][(k + 1) % 3];
    const double t = height_[a] / (height_[a] - height_[b]);
    return (1.0 - t) * surface_.points[a] + t * surface_.points[b];
  }

  // From triangle `f`, entered over its side `k`, until the curve ends or comes back.
  Section trace(int f, int k) {
    Section section;
    while (visited_[f] == 0) {
      visited_[f] = 1;
      section.triangles.push_back(f);
      section.points.push_back(crossing(f, k));
      int exit = (k + 1) % 3;
      if (!is_cut(f, exit)) exit = (k + 2) % 3;
      const int g = neighbours_[f][exit];
      if (g < 0) return section;
      k = static_cast<int>(std::find(neighbours_[g].begin(), neighbours_[g].end(), f) -
                           neighbours_[g].begin());
      if (k == 3) return section;
      f = g;
    }
    section.is_closed = f == section.triangles.front();
    return section;
  }

  const TriangleSurface& surface_;
  const std::vector<FaceNeighbours>& neighbours_;
  std::vector<double> height_;
  std::vector<char> visited_;
};

double distance(const Section& section, const Vec3& p) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < section.points.size(); ++i) {
    const Vec3& a = section.points[i];
    const Vec3& b = section.points[(i + 1) % section.points.size()];
    least = std::min(least, (nearest_point_of_triangle(p, a, b, b) - p).norm());
  }
  return least;
}

bool is_around(const Section& section, const CutPlane& plane) {
  double angle = 0.0;
  for (std::size_t i = 0; i < section.points.size(); ++i) {
    const Vec3 a = section.points[i] - plane.point;
    const Vec3 b = section.points[(i + 1) % section.points.size()] - plane.point;
    angle += std::atan2(a.cross(b).dot(plane.normal), a.dot(b));
  }
  return section.is_closed && std::abs(angle) > std::numbers::pi;
}

bool is_within(const Section& section, const CutPlane& plane) {
  return !plane.radius || std::all_of(section.points.begin(), section.points.end(), [&](auto& p) {
    return (p - plane.point).norm() <= *plane.radius;
  });
}

Section choose(const std::vector<Section>& sections, const CutPlane& plane) {
  const Section* best = nullptr;
  std::pair<bool, double> best_rank;  // sections around the point before the others
  for (const Section& section : sections) {
    if (!is_within(section, plane)) continue;
    const std::pair rank(!is_around(section, plane), distance(section, plane.point));
    if (best == nullptr || rank < best_rank) {
      best = &section;
      best_rank = rank;
    }
  }
  if (best == nullptr && sections.empty()) refuse(plane, "misses the surface");
  if (best == nullptr) refuse(plane, "meets the surface nowhere within its radius alone");
  if (!best->is_closed) {
    refuse(plane,
           "does not go all around the vessel: its section runs into a boundary or a non-manifold "
           "edge. Move it away from there");
  }
  const double radius = loop_shape(best->points).radius;
  const double off = distance(*best, plane.point);
  if (!plane.radius && off > farthest_point * radius) {
    refuse(plane, fmt::format("is {:.4g} away from the nearest section, which has a radius of "
                              "{:.3g}. Move its point to that section, or give it a radius",
                              off, radius));
  }
  return *best;
}

// --- cutting ------------------------------------------------------------------------------------

class Cutter {
 public:
  Cutter(const TriangleSurface& surface, const std::vector<FaceNeighbours>& neighbours,
         const CutPlane& plane, const Section& section)
      : surface_(surface), plane_(plane), section_(section), points_(surface.points) {
    for (const int f : section.triangles) {
      for (const int v : surface.triangles[f]) {
        side_[v] = height(plane, points_[v]) < 0.0 ? -1 : 1;
      }
    }
    for (int f = 0; f < static_cast<int>(surface.triangles.size()); ++f) {
      for (int k = 0; k < 3; ++k) {
        const auto it = side_.find(surface.triangles[f][k]);
        if (it == side_.end()) continue;
        around_[it->first].push_back(f);
        if (neighbours[f][k] < 0 || neighbours[f][(k + 2) % 3] < 0) is_fixed_[it->first] = true;
      }
    }
  }

  /// Nothing if the cut is entangled.
  std::optional<ClipResult> run(double sliding) {
    slide_vertices(sliding);
    split_triangles();
    return remove_upper_side();
  }

 private:
  struct Slide {
    double fraction;
    int vertex;
    Vec3 to;
  };

  Vec3 on_plane(const Vec3& p) const { return p - height(plane_, p) * plane_.normal; }

  Vec3 crossing(int a, int b) const {
    const double ha = height(plane_, surface_.points[a]);
    const double t = ha / (ha - height(plane_, surface_.points[b]));
    return on_plane((1.0 - t) * surface_.points[a] + t * surface_.points[b]);
  }

  // The shortest slide of each vertex, shortest first.
  std::vector<Slide> possible_slides(double sliding) const {
    std::map<int, Slide> shortest;
    for (const int f : section_.triangles) {
      for (int side = 0; side < 6; ++side) {  // from each corner to both others
        const int a = surface_.triangles[f][side / 2];
        const int b = surface_.triangles[f][(side / 2 + side % 2 + 1) % 3];
        if (side_.at(a) == side_.at(b)) continue;
        const double ha = std::abs(height(plane_, surface_.points[a]));
        const double fraction = ha / (ha + std::abs(height(plane_, surface_.points[b])));
        const auto it = shortest.find(a);
        const bool is_longer = it != shortest.end() && it->second.fraction <= fraction;
        if (fraction > sliding || is_longer) continue;
        shortest.insert_or_assign(a, Slide{fraction, a, crossing(a, b)});
      }
    }
    std::vector<Slide> slides;
    for (const auto& [vertex, slide] : shortest) slides.push_back(slide);
    std::stable_sort(slides.begin(), slides.end(),
                     [](const Slide& a, const Slide& b) { return a.fraction < b.fraction; });
    return slides;
  }

  void slide_vertices(double sliding) {
    for (const Slide& slide : possible_slides(sliding)) {
      if (!can_slide(slide)) continue;
      points_[slide.vertex] = slide.to;
      side_[slide.vertex] = 0;
    }
  }

  // No triangle around may flip, nor come to lie in the plane.
  bool can_slide(const Slide& slide) const {
    const Vec3& from = points_[slide.vertex];
    if (from != slide.to && is_fixed_.contains(slide.vertex)) return false;
    const auto& around = around_.at(slide.vertex);
    return std::all_of(around.begin(), around.end(), [&](int f) {
      std::array<Vec3, 3> before;
      std::array<Vec3, 3> after;
      int others_on_plane = 0;
      for (int k = 0; k < 3; ++k) {
        const int v = surface_.triangles[f][k];
        before[k] = points_[v];
        after[k] = v == slide.vertex ? slide.to : points_[v];
        const auto it = side_.find(v);
        if (v != slide.vertex && it != side_.end() && it->second == 0) ++others_on_plane;
      }
      const Vec3 old_area = (before[1] - before[0]).cross(before[2] - before[0]);
      const Vec3 new_area = (after[1] - after[0]).cross(after[2] - after[0]);
      return others_on_plane < 2 &&
             new_area.dot(old_area) >= least_area_left * old_area.squaredNorm();
    });
  }

  int vertex_between(int a, int b) {
    const auto [it, is_new] =
        between_.try_emplace(std::minmax(a, b), static_cast<int>(points_.size()));
    if (is_new) {
      // From the lower vertex to the higher one, so that both triangles of the edge agree.
      const double ha = height(plane_, points_[it->first.first]);
      const double t = ha / (ha - height(plane_, points_[it->first.second]));
      points_.push_back(
          on_plane((1.0 - t) * points_[it->first.first] + t * points_[it->first.second]));
      side_[it->second] = 0;
    }
    return it->second;
  }

  void add(const std::array<int, 3>& triangle, int origin, bool is_lower) {
    triangles_.push_back(triangle);
    origin_.push_back(origin);
    is_lower_.push_back(is_lower);
  }

  void add_piece(const std::array<int, 3>& triangle, int origin) {
    add(triangle, origin,
        std::any_of(triangle.begin(), triangle.end(), [&](int v) { return side_.at(v) < 0; }));
  }

  // A triangle beside the section lies on the side where its vertices were before they slid.
  bool was_lower(int f) const {
    const auto& t = surface_.triangles[f];
    return std::any_of(t.begin(), t.end(), [&](int v) {
      return side_.contains(v) && height(plane_, surface_.points[v]) < 0.0;
    });
  }

  void split_triangles() {
    std::vector<char> is_on_section(surface_.triangles.size(), 0);
    for (const int f : section_.triangles) is_on_section[f] = 1;
    for (int f = 0; f < static_cast<int>(is_on_section.size()); ++f) {
      if (is_on_section[f] != 0) {
        split(f);
      } else {
        add(surface_.triangles[f], f, was_lower(f));
      }
    }
  }

  void split(int f) {
    std::array<int, 3> t = surface_.triangles[f];
    const auto is_cut = [&](int a, int b) { return side_.at(a) * side_.at(b) < 0; };
    const int cuts = static_cast<int>(is_cut(t[0], t[1])) + static_cast<int>(is_cut(t[1], t[2])) +
                     static_cast<int>(is_cut(t[2], t[0]));
    if (cuts == 0) return add_piece(t, f);
    // Corner 0 is the one in the plane, or the one that is alone on its side.
    while (cuts == 1 ? !is_cut(t[1], t[2]) : is_cut(t[1], t[2])) {
      std::rotate(t.begin(), t.begin() + 1, t.end());
    }
    if (cuts == 1) {
      const int middle = vertex_between(t[1], t[2]);
      add_piece({t[0], t[1], middle}, f);
      add_piece({t[0], middle, t[2]}, f);
      return;
    }
    const int p = vertex_between(t[0], t[1]);
    const int q = vertex_between(t[0], t[2]);
    add_piece({t[0], p, q}, f);
    if ((points_[p] - points_[t[2]]).norm() < (points_[q] - points_[t[1]]).norm()) {
      add_piece({p, t[1], t[2]}, f);
      add_piece({p, t[2], q}, f);
    } else {
      add_piece({p, t[1], q}, f);
      add_piece({q, t[1], t[2]}, f);
    }
  }

  bool is_on_plane(int v) const {
    const auto it = side_.find(v);
    return it != side_.end() && it->second == 0;
  }

  std::optional<ClipResult> remove_upper_side() {
    const auto neighbours = face_neighbours(triangles_);
    std::vector<std::array<int, 2>> loop_edges;
    std::vector<int> upper;  // reached so far
    std::vector<char> removed(triangles_.size(), 0);
    const auto reach = [&](int g) {
      if (removed[g] == 0) upper.push_back(g);
      removed[g] = 1;
    };
    for (std::size_t f = 0; f < triangles_.size(); ++f) {
      for (int k = 0; is_lower_[f] && k < 3; ++k) {
        const std::array<int, 2> edge{triangles_[f][k], triangles_[f][(k + 1) % 3]};
        const int g = neighbours[f][k];
        if (!is_on_plane(edge[0]) || !is_on_plane(edge[1]) || (g >= 0 && is_lower_[g])) continue;
        loop_edges.push_back(edge);
        if (g >= 0) reach(g);
      }
    }
    for (std::size_t next = 0; next < upper.size();) {
      const int f = upper[next++];
      for (int k = 0; k < 3; ++k) {
        const int g = neighbours[f][k];
        const auto& t = triangles_[f];
        if (g < 0 || (is_lower_[g] && is_on_plane(t[k]) && is_on_plane(t[(k + 1) % 3]))) continue;
        reach(g);
      }
    }
    auto loop = single_cycle(loop_edges);
    const bool is_divided =
        std::none_of(upper.begin(), upper.end(), [&](int f) { return is_lower_[f]; });
    if (!loop || !is_divided) return std::nullopt;
    return kept(removed, *loop);
  }

  ClipResult kept(const std::vector<char>& removed, const std::vector<int>& loop) const {
    ClipResult result;
    std::vector<int> kept_triangles;
    for (int f = 0; f < static_cast<int>(triangles_.size()); ++f) {
      if (removed[f] != 0) continue;
      kept_triangles.push_back(f);
      result.origin.push_back(origin_[f]);
    }
    Part part = part_of({points_, triangles_}, kept_triangles);
    result.surface = std::move(part.surface);
    for (const int v : loop) result.loop.push_back(part.number[v]);
    return result;
  }

  const TriangleSurface& surface_;
  const CutPlane& plane_;
  const Section& section_;
  std::vector<Vec3> points_;
  std::map<int, int> side_;                 // of vertices beside the section: -1, 0 in the plane, 1
  std::map<int, std::vector<int>> around_;  // triangles of these vertices
  std::map<int, bool> is_fixed_;            // vertices of boundaries
  std::map<std::pair<int, int>, int> between_;
  std::vector<std::array<int, 3>> triangles_;
  std::vector<int> origin_;
  std::vector<bool> is_lower_;  // of triangles at the section: below the plane
};

}  // namespace

ClipResult clip(const TriangleSurface& surface, const CutPlane& plane) {
  const auto neighbours = face_neighbours(surface.triangles);
  const Section section = choose(SectionTracer(surface, neighbours, plane).run(), plane);
  for (const double sliding : {sliding_distance, rounding_distance}) {
    auto result = Cutter(surface, neighbours, plane, section).run(sliding);
    if (result) return std::move(*result);
  }
  refuse(plane, "does not divide the surface: both sides are connected elsewhere");
}

}  // namespace hexwall
