#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>

#include "surface/counted.h"
#include "surface/repair_steps.h"
#include "surface/surface_editor.h"

namespace hexwall::repair {
namespace {

// Triangles below this quality are slivers: needles of less than about 0.6 degrees and caps of more
// than 168. The worst triangles of surfaces that meshing programs make have 0.07 and more.
constexpr double sliver_quality = 0.02;

// What replaces a sliver must be clearly better, or the work might go round in circles.
constexpr double least_gain = 1.1;

// Cosine by which a triangle may turn: a collapse must not fold the surface.
constexpr double greatest_turn = 0.5;

// Share of the tolerance by which a vertex may lie off the loop that goes on without it.
constexpr double loop_share = 0.01;

// Slivers in the neighbourhood of slivers take a few passes.
constexpr int greatest_passes = 10;

using Triangle = std::array<int, 3>;

/// Takes slivers out one by one. Every triangle carries a bound on its distance from the surface
/// that came in; no change that would raise one above the tolerance is made.
class SliverRemover {
 public:
  SliverRemover(State& state, double tolerance)
      : surface_(state.surface),
        origin_(state.origin),
        tolerance_(tolerance),
        editor_(state.surface, state.origin),
        moved_(state.surface.triangles.size(), 0.0) {}

  std::vector<Vec3> run() {
    std::vector<Vec3> places;
    for (int pass = 0; pass < greatest_passes; ++pass) {
      const std::size_t before = places.size();
      for (int f = 0; f < editor_.triangle_count(); ++f) {
        if (!editor_.is_alive(f) || !(quality_of(editor_.triangle(f)) < sliver_quality)) continue;
        const Vec3 place = centroid(surface_, f);
        if (take_out(f)) places.push_back(place);
      }
      if (places.size() == before) break;
    }
    editor_.finish();
    return places;
  }

 private:
  const Vec3& point(int v) const { return surface_.points[v]; }

  double quality_of(const Triangle& t) const {
    return quality(point(t[0]), point(t[1]), point(t[2]));
  }

  Vec3 area_vector(const Triangle& t) const {
    return (point(t[1]) - point(t[0])).cross(point(t[2]) - point(t[0]));
  }

  // Sides from the shortest to the longest, each by its first corner.
  std::array<int, 3> sides_by_length(const Triangle& t) const {
    std::array<int, 3> sides{0, 1, 2};
    const auto length = [&](int k) { return (point(t[(k + 1) % 3]) - point(t[k])).squaredNorm(); };
    std::stable_sort(sides.begin(), sides.end(),
                     [&](int k, int l) { return length(k) < length(l); });
    return sides;
  }

  bool take_out(int f) {
    const Triangle t = editor_.triangle(f);
    const std::array<int, 3> sides = sides_by_length(t);
    const auto ends = [&](int side) { return std::pair(t[side], t[(side + 1) % 3]); };
    const auto [a, b] = ends(sides[0]);
    if (collapse(a, b) || collapse(b, a)) return true;
    const auto [c, d] = ends(sides[2]);
    return editor_.is_boundary_edge(c, d) ? draw_to_boundary(f, c, d) : flip(f, c, d);
  }

  /// What triangles are like before a change.
  struct Former {
    double worst_quality = 1.0;
    Vec3 area_vector = Vec3::Zero();
    double moved = 0.0;
  };

  Former former_of(const std::vector<int>& faces) const {
    Former former;
    for (const int f : faces) {
      former.worst_quality = std::min(former.worst_quality, quality_of(editor_.triangle(f)));
      former.area_vector += area_vector(editor_.triangle(f));
      former.moved = std::max(former.moved, moved_[f]);
    }
    return former;
  }

  /// The new triangles are better, the surface is not folded, and not too far away.
  bool is_allowed(const Former& former, const std::vector<Triangle>& after, double distance) const {
    if (!(former.moved + distance <= tolerance_)) return false;
    const Vec3 normal = former.area_vector.normalized();
    return std::all_of(after.begin(), after.end(), [&](const Triangle& t) {
      const Vec3 area = area_vector(t);
      return quality_of(t) > least_gain * former.worst_quality &&
             area.dot(normal) > greatest_turn * area.norm();
    });
  }

  /// Merges `u` into `v`: the triangles around u are sheared by the edge's length at most.
  bool collapse(int u, int v) {
    const bool is_boundary = editor_.is_boundary_vertex(u);
    if (is_boundary && !is_straight_boundary(u, v)) return false;
    if (!editor_.can_merge(u, v)) return false;
    const std::vector<int> before = editor_.faces(u);
    std::vector<Triangle> after;
    for (const int f : before) {
      const Triangle& t = editor_.triangle(f);
      if (std::find(t.begin(), t.end(), v) == t.end()) after.push_back(replaced(t, u, v));
    }
    const double distance = (point(u) - point(v)).norm();
    const Former former = former_of(before);
    if (!is_allowed(former, after, distance)) return false;
    editor_.merge(u, v);
    for (const int f : before) moved_[f] = former.moved + distance;
    return true;
  }

  // The loop stays where it is if u lies between its neighbours and one of them is v.
  bool is_straight_boundary(int u, int v) const {
    if (!editor_.is_boundary_edge(u, v)) return false;
    for (const int w : editor_.neighbours(u)) {
      if (w == v || !editor_.is_boundary_edge(u, w)) continue;
      return (point(u) - foot(u, v, w)).norm() <= loop_share * tolerance_;
    }
    return false;
  }

  /// Flips the longest edge (a, b) of the cap f, which lifts a point of the edge to the cap's third
  /// vertex.
  bool flip(int f, int a, int b) {
    const std::vector<int> before = editor_.faces_at(a, b);
    if (before.size() != 2) return false;
    const Triangle t = editor_.triangle(f);
    const int c = third_vertex(t, a, b);
    const int d = third_vertex(editor_.triangle(before[0] == f ? before[1] : before[0]), a, b);
    if (c == d || !editor_.faces_at(c, d).empty()) return false;
    const std::vector<Triangle> after{replaced(t, b, d), replaced(t, a, d)};
    const double distance = (point(c) - foot(c, a, b)).norm();
    const Former former = former_of(before);
    if (!is_allowed(former, after, distance)) return false;
    const int origin = origin_[f];
    for (const int g : before) editor_.remove(g);
    for (const Triangle& n : after) {
      editor_.add(n, origin);
      moved_.push_back(former.moved + distance);
    }
    return true;
  }

  // Of vertex v on the line through a and b.
  Vec3 foot(int v, int a, int b) const {
    const Vec3 along = (point(b) - point(a)).normalized();
    return point(a) + along.dot(point(v) - point(a)) * along;
  }

  /// Takes away the cap f with its longest edge (a, b) on the boundary by moving its third vertex
  /// onto that edge.
  bool draw_to_boundary(int f, int a, int b) {
    const int v = third_vertex(editor_.triangle(f), a, b);
    if (editor_.is_boundary_vertex(v)) return false;
    const std::vector<int> before = editor_.faces(v);
    const Former former = former_of(before);
    std::vector<Triangle> after;
    for (const int g : before) {
      if (g != f) after.push_back(editor_.triangle(g));
    }
    const Vec3 place = std::exchange(surface_.points[v], foot(v, a, b));
    const double distance = (point(v) - place).norm();
    if (!is_allowed(former, after, distance)) {
      surface_.points[v] = place;
      return false;
    }
    editor_.remove(f);
    for (const int g : before) moved_[g] = former.moved + distance;
    return true;
  }

  TriangleSurface& surface_;
  std::vector<int>& origin_;
  double tolerance_;
  SurfaceEditor editor_;
  std::vector<double> moved_;
};

}  // namespace

Outcome remove_slivers(State& state, double tolerance) {
  const auto& points = state.surface.points;
  const auto is_sliver = [&](const Triangle& t) {
    return quality(points[t[0]], points[t[1]], points[t[2]]) < sliver_quality;
  };
  const auto& triangles = state.surface.triangles;
  if (std::none_of(triangles.begin(), triangles.end(), is_sliver)) return {};
  const std::vector<Vec3> places = SliverRemover(state, tolerance).run();
  return {places, counted(places.size(), "sliver was collapsed or flipped",
                          "slivers were collapsed or flipped")};
}

}  // namespace hexwall::repair
