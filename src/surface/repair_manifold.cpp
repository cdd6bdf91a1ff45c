#include <algorithm>
#include <functional>
#include <map>
#include <numeric>

#include <fmt/format.h>

#include "core/errors.h"
#include "surface/counted.h"
#include "surface/edge_uses.h"
#include "surface/orient.h"
#include "surface/repair_steps.h"
#include "surface/surface_editor.h"

namespace hexwall::repair {
namespace {

/// Disjoint sets of the numbers from 0 to n - 1.
class Sets {
 public:
  explicit Sets(int n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }
  int root(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  // The lowest number stays the root.
  void join(int i, int j) {
    const auto [low, high] = std::minmax({root(i), root(j)});
    parent_[high] = low;
  }

 private:
  std::vector<int> parent_;
};

int triangle_count(const State& state) {
  return static_cast<int>(state.surface.triangles.size());
}

/// Sum of the areas of the triangles of each set, at its root.
std::vector<double> areas_of(const State& state, Sets& sets) {
  std::vector<double> areas(state.surface.triangles.size(), 0.0);
  for (int f = 0; f < triangle_count(state); ++f) {
    areas[sets.root(f)] += 0.5 * doubled_area_vector(state.surface, f).norm();
  }
  return areas;
}

/// Uses of one edge with more than two triangles.
using CrowdedEdge = std::vector<EdgeUse>;

/// Triangles joined over edges with two triangles, and the edges with more.
struct Sheets {
  std::vector<EdgeUse> uses;
  Sets sets;
  std::vector<double> areas;
  std::vector<bool> has_free_edge;  // by root
  std::vector<CrowdedEdge> crowded;
};

Sheets find_sheets(const State& state) {
  Sheets sheets{edge_uses(state.surface.triangles), Sets(triangle_count(state)), {}, {}, {}};
  std::vector<int> free;
  for_each_edge(sheets.uses, [&](auto first, auto last) {
    if (last - first == 1) free.push_back(first->face);
    if (last - first == 2) sheets.sets.join(first[0].face, first[1].face);
    if (last - first > 2) sheets.crowded.emplace_back(first, last);
  });
  if (sheets.crowded.empty()) return sheets;
  sheets.areas = areas_of(state, sheets.sets);
  sheets.has_free_edge.assign(sheets.areas.size(), false);
  for (const int f : free) sheets.has_free_edge[sheets.sets.root(f)] = true;
  return sheets;
}

/// Chooses among the sheets at crowded edges those that are surplus.
class SurplusFinder {
 public:
  SurplusFinder(Sheets& sheets, double small_area) : sheets_(sheets), small_area_(small_area) {
    for (std::size_t e = 0; e < sheets.crowded.size(); ++e) {
      for (const EdgeUse& use : sheets.crowded[e]) {
        auto& edges = edges_[sheets.sets.root(use.face)];
        if (edges.empty() || edges.back() != e) edges.push_back(e);
      }
    }
  }

  /// Roots of the sheets to drop, found from the smallest on.
  std::vector<int> find() {
    std::vector<int> candidates;
    for (const auto& [sheet, edges] : edges_) {
      if (is_small(sheet)) candidates.push_back(sheet);
    }
    std::stable_sort(candidates.begin(), candidates.end(),
                     [&](int s, int t) { return sheets_.areas[s] < sheets_.areas[t]; });
    std::vector<int> dropped;
    for (const int sheet : candidates) {
      const auto& edges = edges_[sheet];
      if (!std::all_of(edges.begin(), edges.end(), [&](auto e) { return is_surplus(sheet, e); })) {
        continue;
      }
      for (const std::size_t e : edges) {
        std::erase_if(sheets_.crowded[e],
                      [&](const EdgeUse& use) { return sheets_.sets.root(use.face) == sheet; });
      }
      dropped.push_back(sheet);
    }
    return dropped;
  }

 private:
  bool is_small(int sheet) const { return sheets_.areas[sheet] < small_area_; }

  // Beside two triangles of large sheets every small one is a fin. Where a large sheet goes on in
  // one of several small ones, only those without an edge of their own are sure to be inner or
  // doubled walls; another may be a short branch.
  bool is_surplus(int sheet, std::size_t edge) {
    const CrowdedEdge& uses = sheets_.crowded[edge];
    int left = 0;
    int large = 0;
    bool may_be_branch = false;
    for (const EdgeUse& use : uses) {
      const int s = sheets_.sets.root(use.face);
      if (s != sheet) ++left;
      if (!is_small(s)) ++large;
      if (is_small(s) && sheets_.has_free_edge[s]) may_be_branch = true;
    }
    return left >= 2 && uses.size() > 2 && (large >= 2 || !may_be_branch);
  }

  Sheets& sheets_;
  double small_area_;
  std::map<int, std::vector<std::size_t>> edges_;
};

/// Drops surplus sheets, round after round, as sheets grow together; adds a place for each.
int drop_surplus_sheets(State& state, double small, std::vector<Vec3>& places) {
  int dropped_triangles = 0;
  while (true) {
    Sheets sheets = find_sheets(state);
    if (sheets.crowded.empty()) return dropped_triangles;
    const std::vector<int> surplus =
        SurplusFinder(sheets, small * total_area(state.surface)).find();
    if (surplus.empty()) return dropped_triangles;
    std::vector<bool> is_surplus(state.surface.triangles.size(), false);
    for (const int s : surplus) {
      is_surplus[s] = true;
      places.push_back(centroid(state.surface, s));
    }
    std::vector<bool> keep(is_surplus.size());
    for (int f = 0; f < triangle_count(state); ++f) keep[f] = !is_surplus[sheets.sets.root(f)];
    dropped_triangles += static_cast<int>(std::count(keep.begin(), keep.end(), false));
    keep_triangles(state.surface, state.origin, keep);
  }
}

/// The uses of an edge that stay joined: all of them, but where each of several sheets has two, as
/// where parts touch along an edge, each sheet by itself.
std::vector<std::vector<EdgeUse>> joined_uses(const std::vector<EdgeUse>& uses, Sets& sheets) {
  std::map<int, std::vector<EdgeUse>> by_sheet;
  for (const EdgeUse& use : uses) by_sheet[sheets.root(use.face)].push_back(use);
  const bool is_touching = std::all_of(by_sheet.begin(), by_sheet.end(),
                                       [](const auto& s) { return s.second.size() == 2; });
  if (!is_touching) return {uses};
  std::vector<std::vector<EdgeUse>> result;
  for (auto& [sheet, of_sheet] : by_sheet) result.push_back(std::move(of_sheet));
  return result;
}

/// Corners 3 f + k, joined where the same vertex is in two triangles that share an edge with it.
Sets joined_corners(const State& state) {
  Sheets sheets = find_sheets(state);
  Sets corners(3 * triangle_count(state));
  const auto corner = [&](int f, int v) {
    const auto& t = state.surface.triangles[f];
    return 3 * f + static_cast<int>(std::find(t.begin(), t.end(), v) - t.begin());
  };
  const auto join = [&](const EdgeUse& g, const EdgeUse& h) {
    corners.join(corner(g.face, g.low), corner(h.face, g.low));
    corners.join(corner(g.face, g.high), corner(h.face, g.high));
  };
  for_each_edge(sheets.uses, [&](auto first, auto last) {
    if (last - first == 2) join(first[0], first[1]);
    if (last - first <= 2) return;
    for (const auto& joined : joined_uses({first, last}, sheets.sets)) {
      for (const EdgeUse& use : joined) join(joined.front(), use);
    }
  });
  return corners;
}

/// Gives each further fan of triangles at a vertex a copy of it; adds a place for each.
int separate_fans(State& state, std::vector<Vec3>& places) {
  Sets corners = joined_corners(state);
  std::vector<int> first_fan(state.surface.points.size(), -1);
  std::map<int, int> copy_of_fan;
  for (int c = 0; c < 3 * triangle_count(state); ++c) {
    int& v = state.surface.triangles[c / 3][c % 3];
    const int fan = corners.root(c);
    if (first_fan[v] < 0) first_fan[v] = fan;
    if (first_fan[v] == fan) continue;
    const auto [copy, is_new] =
        copy_of_fan.try_emplace(fan, static_cast<int>(state.surface.points.size()));
    if (is_new) {
      const Vec3 place = state.surface.points[v];
      state.surface.points.push_back(place);
      places.push_back(place);
    }
    v = copy->second;
  }
  return static_cast<int>(copy_of_fan.size());
}

// Of the area: a component with less is not the vessel, of which others are debris.
constexpr double least_kept = 0.5;

[[noreturn]] void refuse_components(const State& state, Sets& sets, const std::vector<int>& roots,
                                    const std::vector<double>& areas) {
  const double total = total_area(state.surface);
  std::vector<int> sizes(areas.size(), 0);
  for (int f = 0; f < triangle_count(state); ++f) ++sizes[sets.root(f)];
  std::string list;
  constexpr std::size_t shown = 5;
  for (std::size_t i = 0; i < std::min(roots.size(), shown); ++i) {
    list += fmt::format("{}{}, {:.1f} % of the area, near {}", i > 0 ? "; " : "",
                        counted(sizes[roots[i]], "triangle"), 100.0 * areas[roots[i]] / total,
                        coordinates(centroid(state.surface, roots[i])));
  }
  const bool has_vessel = areas[roots[0]] >= least_kept * total;
  throw TopologyError(fmt::format(
      "the surface has {} connected components: {}{}. {}", roots.size(), list,
      roots.size() > shown ? "; and more" : "",
      has_vessel ? "Keep only the vessel and delete the rest"
                 : "None of them is the vessel: weld them together or keep only the vessel"));
}

}  // namespace

Outcome remove_duplicates(State& state) {
  std::vector<std::pair<std::array<int, 3>, int>> sorted;
  sorted.reserve(state.surface.triangles.size());
  for (int f = 0; f < triangle_count(state); ++f) {
    sorted.emplace_back(state.surface.triangles[f], f);
    std::sort(sorted.back().first.begin(), sorted.back().first.end());
  }
  std::sort(sorted.begin(), sorted.end());
  std::vector<bool> keep(sorted.size(), true);
  Outcome outcome;
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    if (sorted[i].first != sorted[i - 1].first) continue;
    keep[sorted[i].second] = false;
    outcome.places.push_back(centroid(state.surface, sorted[i].second));
  }
  if (outcome.places.empty()) return outcome;
  keep_triangles(state.surface, state.origin, keep);
  outcome.text = counted(outcome.places.size(), "triangle that repeats another one was dropped",
                         "triangles that repeat another one were dropped");
  return outcome;
}

Outcome make_manifold(State& state, double small) {
  Outcome outcome;
  const int dropped = drop_surplus_sheets(state, small, outcome.places);
  const std::size_t sheets = outcome.places.size();
  const int copies = separate_fans(state, outcome.places);
  if (sheets > 0) {
    outcome.text = fmt::format("{0}, of {1}, {2} dropped",
                               counted(sheets, "fin or inner wall", "fins or inner walls"),
                               counted(dropped, "triangle"), sheets == 1 ? "was" : "were");
  }
  if (copies > 0) {
    outcome.text += fmt::format("{}parts that touch were separated at {}",
                                sheets > 0 ? ", and " : "", counted(copies, "point"));
  }
  return outcome;
}

Outcome keep_largest_component(State& state, double small) {
  // Triangles are joined through the first triangle of each vertex.
  Sets sets(triangle_count(state));
  std::vector<int> first(state.surface.points.size(), -1);
  for (int f = 0; f < triangle_count(state); ++f) {
    for (const int v : state.surface.triangles[f]) {
      if (first[v] < 0) first[v] = f;
      sets.join(f, first[v]);
    }
  }
  std::vector<int> roots;
  for (int f = 0; f < triangle_count(state); ++f) {
    if (sets.root(f) == f) roots.push_back(f);
  }
  if (roots.size() <= 1) return {};
  const std::vector<double> areas = areas_of(state, sets);
  std::stable_sort(roots.begin(), roots.end(), [&](int l, int r) { return areas[l] > areas[r]; });
  const double total = total_area(state.surface);
  if (areas[roots[1]] >= small * total || areas[roots[0]] < least_kept * total) {
    refuse_components(state, sets, roots, areas);
  }
  Outcome outcome;
  for (std::size_t i = 1; i < roots.size(); ++i) {
    outcome.places.push_back(centroid(state.surface, roots[i]));
  }
  std::vector<bool> keep(state.surface.triangles.size());
  for (int f = 0; f < triangle_count(state); ++f) keep[f] = sets.root(f) == roots[0];
  const auto dropped = std::count(keep.begin(), keep.end(), false);
  keep_triangles(state.surface, state.origin, keep);
  outcome.text = fmt::format("{}, of {}, {} dropped", counted(roots.size() - 1, "small component"),
                             counted(dropped, "triangle"), roots.size() == 2 ? "was" : "were");
  return outcome;
}

Outcome turn_outward(State& state) {
  Outcome outcome;
  try {
    OrientResult oriented = orient(state.surface);
    for (int f = 0; f < triangle_count(state); ++f) {
      if (oriented.surface.triangles[f] == state.surface.triangles[f]) continue;
      outcome.places.push_back(centroid(state.surface, f));
    }
    state.surface = std::move(oriented.surface);
  } catch (const TopologyError&) {
    return {};  // a Moebius band, or not manifold: `check_surface` says so
  }
  const bool all = outcome.places.size() == state.surface.triangles.size();
  outcome.text =
      all ? "all triangles were wound inward and were turned"
          : counted(outcome.places.size(), "triangle had the wrong winding and was turned",
                    "triangles had the wrong winding and were turned");
  return outcome;
}

}  // namespace hexwall::repair
