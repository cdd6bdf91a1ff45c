#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "surface/counted.h"
#include "surface/edge_uses.h"
#include "surface/repair_steps.h"
#include "surface/surface_editor.h"

namespace hexwall::repair {
namespace {

// A triangle with T-junctions on all its edges takes three.
constexpr int split_passes = 10;

using BoundaryEdges = std::vector<EdgeUse>;

BoundaryEdges boundary_edges(const TriangleSurface& surface) {
  BoundaryEdges result;
  for_each_edge(edge_uses(surface.triangles), [&](auto first, auto last) {
    if (last - first == 1 && first->low != first->high) result.push_back(*first);
  });
  return result;
}

std::vector<int> vertices_of(const BoundaryEdges& edges) {
  std::vector<int> result;
  for (const EdgeUse& e : edges) {
    result.push_back(e.low);
    result.push_back(e.high);
  }
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

int root_of(std::vector<int>& parent, int v) {
  while (parent[v] != v) v = parent[v] = parent[parent[v]];
  return v;
}

/// For each vertex the lowest number in its cluster of boundary vertices that lie within `distance`
/// of each other. Sweeps along a direction in which vertices of regular grids do not line up.
std::vector<int> cluster(const TriangleSurface& surface, const std::vector<int>& vertices,
                         double distance) {
  const Vec3 direction = Vec3(1.0, 0.7548776662, 0.5698402910).normalized();
  std::vector<std::pair<double, int>> order;
  order.reserve(vertices.size());
  for (const int v : vertices) order.emplace_back(surface.points[v].dot(direction), v);
  std::sort(order.begin(), order.end());
  std::vector<int> parent(surface.points.size());
  std::iota(parent.begin(), parent.end(), 0);
  for (std::size_t i = 0; i < order.size(); ++i) {
    for (std::size_t j = i + 1; j < order.size(); ++j) {
      if (order[j].first - order[i].first > distance) break;
      const int u = order[i].second;
      const int v = order[j].second;
      if ((surface.points[u] - surface.points[v]).norm() > distance) continue;
      const auto [low, high] = std::minmax({root_of(parent, u), root_of(parent, v)});
      parent[high] = low;
    }
  }
  for (int v = 0; v < static_cast<int>(parent.size()); ++v) parent[v] = root_of(parent, v);
  return parent;
}

/// Finds chains of boundary edges that run along another boundary edge.
class ChainFinder {
 public:
  ChainFinder(const TriangleSurface& surface, const BoundaryEdges& edges,
              const std::vector<int>& root, double distance)
      : points_(surface.points), root_(root), distance_(distance) {
    for (const EdgeUse& e : edges) {
      steps_[root[e.low]].push_back({e.high, e.face});
      steps_[root[e.high]].push_back({e.low, e.face});
    }
  }

  /// The vertices between the ends `a` and `b` of a boundary edge of triangle `f`, from `a` on;
  /// empty if there is no such chain.
  std::vector<int> between(int a, int b, int f) const {
    std::vector<int> chain;
    double reached = 0.0;
    for (int at = a; root_[at] != root_[b];) {
      const int next = next_along(a, b, at, f, reached);
      if (next < 0) return {};
      if (root_[next] != root_[b]) chain.push_back(next);
      at = next;
    }
    return chain;
  }

 private:
  struct Step {
    int to, face;
  };

  int next_along(int a, int b, int at, int f, double& reached) const {
    const Vec3 along = points_[b] - points_[a];
    const double squared = along.squaredNorm();
    for (const Step& step : steps_.at(root_[at])) {
      if (step.face == f) continue;
      const Vec3 offset = points_[step.to] - points_[a];
      const double t = offset.dot(along) / squared;
      const bool is_end = root_[step.to] == root_[b];
      if (!(t > reached) || (!is_end && t >= 1.0)) continue;
      if (!is_end && (offset - t * along).norm() > distance_) continue;
      reached = t;
      return step.to;
    }
    return -1;
  }

  const std::vector<Vec3>& points_;
  const std::vector<int>& root_;
  double distance_;
  std::map<int, std::vector<Step>> steps_;
};

/// The triangle as a fan from its third vertex, with the vertices of `chain` on the edge (a, b).
std::vector<std::array<int, 3>> fan(const std::array<int, 3>& triangle, int a, int b,
                                    const std::vector<int>& chain) {
  std::vector<std::array<int, 3>> result;
  int from = a;
  for (std::size_t i = 0; i <= chain.size(); ++i) {
    const int to = i < chain.size() ? chain[i] : b;
    // Both ends are replaced at once: `to` may be what `from` was.
    std::array<int, 3> piece{};
    std::transform(triangle.begin(), triangle.end(), piece.begin(), [&](int v) {
      return v == a ? from : v == b ? to : v;
    });
    result.push_back(piece);
    from = to;
  }
  return result;
}

/// Splits triangles at T-junctions, one edge each; returns the vertices in the edges.
std::vector<int> split_once(State& state, const BoundaryEdges& edges, const std::vector<int>& root,
                            double distance) {
  const ChainFinder finder(state.surface, edges, root, distance);
  std::vector<int> inserted;
  std::vector<bool> is_split(state.surface.triangles.size(), false);
  for (const EdgeUse& e : edges) {
    if (is_split[e.face] || root[e.low] == root[e.high]) continue;
    const std::vector<int> chain = finder.between(e.low, e.high, e.face);
    if (chain.empty()) continue;
    const auto pieces = fan(state.surface.triangles[e.face], e.low, e.high, chain);
    state.surface.triangles[e.face] = pieces.front();
    is_split[e.face] = true;
    for (std::size_t i = 1; i < pieces.size(); ++i) {
      state.surface.triangles.push_back(pieces[i]);
      state.origin.push_back(state.origin[e.face]);
    }
    inserted.insert(inserted.end(), chain.begin(), chain.end());
  }
  return inserted;
}

/// Renumbers the ends of boundary edges that have another boundary edge in the same place; returns
/// the vertices that were merged into another one.
std::vector<int> merge_matching_edges(State& state, BoundaryEdges edges,
                                      const std::vector<int>& root) {
  for (EdgeUse& e : edges) {
    const auto [low, high] = std::minmax({root[e.low], root[e.high]});
    e = {low, high, e.face, e.is_forward};
  }
  std::erase_if(edges, [](const EdgeUse& e) { return e.low == e.high; });
  std::sort(edges.begin(), edges.end(), [](const EdgeUse& l, const EdgeUse& r) {
    return std::pair(l.low, l.high) < std::pair(r.low, r.high);
  });
  std::vector<bool> is_merged(state.surface.points.size(), false);  // by root
  for_each_edge(edges, [&](auto first, auto last) {
    if (last - first > 1) is_merged[first->low] = is_merged[first->high] = true;
  });
  std::vector<int> merged;
  for (auto& t : state.surface.triangles) {
    for (int& v : t) {
      if (root[v] == v || !is_merged[root[v]]) continue;
      merged.push_back(v);
      v = root[v];
    }
  }
  std::sort(merged.begin(), merged.end());
  merged.erase(std::unique(merged.begin(), merged.end()), merged.end());
  return merged;
}

}  // namespace

Outcome weld(State& state, double distance) {
  BoundaryEdges edges = boundary_edges(state.surface);
  const std::vector<int> root = cluster(state.surface, vertices_of(edges), distance);
  std::vector<int> found;
  for (int pass = 0; pass < split_passes; ++pass) {
    const std::vector<int> split = split_once(state, edges, root, distance);
    if (split.empty()) break;
    found.insert(found.end(), split.begin(), split.end());
    edges = boundary_edges(state.surface);
  }
  const std::size_t split_count = found.size();
  const std::vector<int> merged = merge_matching_edges(state, std::move(edges), root);
  found.insert(found.end(), merged.begin(), merged.end());
  Outcome outcome;
  for (const int v : found) outcome.places.push_back(state.surface.points[v]);
  if (!merged.empty()) {
    outcome.text =
        counted(merged.size(), "boundary point was merged with another in the same place",
                "boundary points were merged with others in the same place");
  }
  if (split_count > 0) {
    outcome.text += (merged.empty() ? "" : ", and ") +
                    counted(split_count, "point was built into the edge that it lies on",
                            "points were built into the edge that they lie on");
  }
  if (!found.empty()) {
    keep_triangles(state.surface, state.origin,
                   std::vector<bool>(state.surface.triangles.size(), true));
  }
  return outcome;
}

}  // namespace hexwall::repair
