#include <algorithm>
#include <array>
#include <deque>
#include <numeric>

#include "surface/counted.h"
#include "surface/repair_steps.h"
#include "surface/surface_editor.h"

namespace hexwall::repair {
namespace {

bool has_repeated_vertex(const std::array<int, 3>& t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

/// The two sides of a triangle that uses a vertex twice lie on each other: its neighbours meet
/// there once it is gone.
std::vector<Vec3> drop_repeated(State& state) {
  std::vector<bool> keep(state.surface.triangles.size(), true);
  std::vector<Vec3> places;
  for (int f = 0; f < static_cast<int>(keep.size()); ++f) {
    if (!has_repeated_vertex(state.surface.triangles[f])) continue;
    keep[f] = false;
    places.push_back(centroid(state.surface, f));
  }
  if (!places.empty()) keep_triangles(state.surface, state.origin, keep);
  return places;
}

/// Works through triangles without area until none is left that can be taken out.
/// \pre no triangle uses a vertex twice.
class Cleaner {
 public:
  Cleaner(State& state, double distance)
      : surface_(state.surface),
        origin_(state.origin),
        distance_(distance),
        editor_(state.surface, state.origin) {}

  /// Returns the places of those of the triangles `flat` that are gone.
  std::vector<Vec3> run(const std::vector<int>& flat) {
    std::vector<Vec3> centroids;
    for (const int f : flat) centroids.push_back(centroid(surface_, f));
    queue_.assign(flat.begin(), flat.end());
    // Splitting replaces an edge by shorter ones, merging takes a vertex away: both end. The bound
    // is for coordinates so large that lengths can't be compared.
    for (std::size_t left = 1000 + 100 * flat.size(); !queue_.empty() && left > 0; --left) {
      const int f = queue_.front();
      queue_.pop_front();
      if (editor_.is_alive(f) && !has_area(surface_, f)) take_out(f);
    }
    std::vector<Vec3> places;
    for (std::size_t i = 0; i < flat.size(); ++i) {
      if (!editor_.is_alive(flat[i]) || has_area(surface_, flat[i])) places.push_back(centroids[i]);
    }
    editor_.finish();
    return places;
  }

 private:
  // The edge from corner k on.
  double length(int f, int k) const {
    const auto& t = editor_.triangle(f);
    return (surface_.points[t[(k + 1) % 3]] - surface_.points[t[k]]).norm();
  }

  void take_out(int f) {
    const std::array<int, 3> t = editor_.triangle(f);
    std::array<int, 3> corners{0, 1, 2};
    std::sort(corners.begin(), corners.end(),
              [&](int k, int l) { return length(f, k) < length(f, l); });
    if (length(f, corners[0]) > distance_) {
      split_neighbours(f, t[corners[2]], t[(corners[2] + 1) % 3]);
    } else {
      merge_ends(t[corners[0]], t[(corners[0] + 1) % 3]);
    }
  }

  void merge_ends(int a, int b) {
    const auto [low, high] = std::minmax({a, b});
    if (!editor_.can_merge(high, low)) return;
    editor_.merge(high, low);
    for (const int f : editor_.faces(low)) queue_.push_back(f);
  }

  /// Removes the triangle f = (a, b, v), whose v lies on the edge (a, b), and lets the other
  /// triangles at that edge run through v.
  void split_neighbours(int f, int a, int b) {
    const int v = third_vertex(editor_.triangle(f), a, b);
    std::vector<int> others = editor_.faces_at(a, b);
    std::erase(others, f);
    const bool is_blocked = std::any_of(others.begin(), others.end(), [&](int g) {
      const int d = third_vertex(editor_.triangle(g), a, b);
      return d != v && !editor_.faces_at(v, d).empty();
    });
    if (is_blocked) return;
    editor_.remove(f);
    for (const int g : others) {
      const std::array<int, 3> t = editor_.triangle(g);
      editor_.remove(g);
      if (third_vertex(t, a, b) == v) continue;  // both folded together: nothing is left of them
      queue_.push_back(editor_.add(replaced(t, b, v), origin_[g]));
      queue_.push_back(editor_.add(replaced(t, a, v), origin_[g]));
    }
  }

  TriangleSurface& surface_;
  std::vector<int>& origin_;
  double distance_;
  SurfaceEditor editor_;
  std::deque<int> queue_;
};

}  // namespace

Outcome remove_degenerate(State& state, double distance) {
  std::vector<Vec3> places = drop_repeated(state);
  std::vector<int> flat;
  for (int f = 0; f < static_cast<int>(state.surface.triangles.size()); ++f) {
    if (!has_area(state.surface, f)) flat.push_back(f);
  }
  if (!flat.empty()) {
    const std::vector<Vec3> more = Cleaner(state, distance).run(flat);
    places.insert(places.end(), more.begin(), more.end());
  }
  return {places, counted(places.size(), "triangle without area was taken out",
                          "triangles without area were taken out")};
}

}  // namespace hexwall::repair
