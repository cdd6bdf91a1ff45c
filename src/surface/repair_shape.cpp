#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/errors.h"
#include "surface/connectivity.h"
#include "surface/counted.h"
#include "surface/remesh.h"
#include "surface/repair_steps.h"
#include "surface/self_intersection.h"
#include "surface/surface_distance.h"

namespace hexwall::repair {
namespace {

// Remeshing moves every vertex, so that it waits until the triangles are hopeless. Of 19 vessel
// surfaces as they come, none has more than 2 % of its area in triangles of this quality.
constexpr double poor_quality = 0.1;
constexpr double greatest_poor_share = 0.1;

constexpr double greatest_triangle_count = 1e7;
// Unasked for, no surface is remeshed that would take so many times its triangles and edges, unless
// they are few all the same, or has a side of so many edges: some surfaces are so far out of
// proportion (a spike) that no mesh of even size is what the user wants, or could wait for.
constexpr double greatest_growth = 30.0;
constexpr double few_triangles = 20000.0;
constexpr double greatest_side = 100.0;

// Smoothing of self-intersections: rounds, and steps in each of them. The neighbourhood grows by a
// ring of triangles every second round.
constexpr int smoothing_rounds = 12;
constexpr int smoothing_steps = 5;

double equilateral_area(double edge) {
  return 0.25 * std::sqrt(3.0) * edge * edge;
}

bool is_poor(const TriangleSurface& surface, int f) {
  const auto& [a, b, c] = surface.triangles[f];
  return quality(surface.points[a], surface.points[b], surface.points[c]) < poor_quality;
}

double poor_share(const TriangleSurface& surface) {
  double poor = 0.0;
  for (int f = 0; f < static_cast<int>(surface.triangles.size()); ++f) {
    if (is_poor(surface, f)) poor += 0.5 * doubled_area_vector(surface, f).norm();
  }
  return poor / total_area(surface);
}

double mean_boundary_edge(const TriangleSurface& surface, const Connectivity& mesh) {
  double sum = 0.0;
  int count = 0;
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (!mesh.is_boundary_edge(e)) continue;
    const int h = mesh.halfedge(e);
    sum += (surface.points[mesh.tip(h)] - surface.points[mesh.tail(h)]).norm();
    ++count;
  }
  return count > 0 ? sum / count : std::numeric_limits<double>::infinity();
}

double default_edge(const TriangleSurface& surface) {
  const Connectivity mesh = connectivity_of(surface);
  const double mean_area = total_area(surface) / static_cast<double>(surface.triangles.size());
  return std::min(std::sqrt(mean_area / equilateral_area(1.0)), mean_boundary_edge(surface, mesh));
}

void check_edge(const TriangleSurface& surface, double edge) {
  if (total_area(surface) / equilateral_area(edge) <= greatest_triangle_count) return;
  throw UsageError(fmt::format(
      "remeshing with the edge length {:g} would take more than 10 million triangles; ask for a "
      "longer one",
      edge));
}

/// The pieces of the length `edge`, or the size of such a triangle, into which remeshing has to cut
/// a triangle's side, or the triangle, in the mean.
double pieces(const TriangleSurface& surface, double edge) {
  const double of_side = mean_edge_length(surface) / edge;
  const auto count = static_cast<double>(surface.triangles.size());
  return std::max(of_side, total_area(surface) / (equilateral_area(edge) * count));
}

double longest_side(const TriangleSurface& surface) {
  double longest = 0.0;
  for (const auto& t : surface.triangles) {
    for (int k = 0; k < 3; ++k) {
      longest = std::max(longest, (surface.points[t[(k + 1) % 3]] - surface.points[t[k]]).norm());
    }
  }
  return longest;
}

/// Smooths the surroundings of self-intersections.
class Smoother {
 public:
  Smoother(TriangleSurface& surface, double tolerance)
      : surface_(surface),
        former_(surface.points),
        tolerance_(tolerance),
        mesh_(connectivity_of(surface)) {}

  /// The vertices up to `rings` triangles away from the triangles of `pairs`, those of loops left
  /// out.
  std::vector<int> region(const std::vector<std::pair<int, int>>& pairs, int rings) const {
    std::vector<bool> inside(former_.size(), false);
    for (const auto& [f, g] : pairs) {
      for (const int v : surface_.triangles[f]) inside[v] = true;
      for (const int v : surface_.triangles[g]) inside[v] = true;
    }
    for (int ring = 0; ring < rings; ++ring) {
      std::vector<bool> grown = inside;
      for (const auto& t : surface_.triangles) {
        if (!inside[t[0]] && !inside[t[1]] && !inside[t[2]]) continue;
        for (const int v : t) grown[v] = true;
      }
      inside = std::move(grown);
    }
    std::vector<int> result;
    for (int v = 0; v < static_cast<int>(inside.size()); ++v) {
      if (inside[v] && !mesh_.is_boundary_vertex(v)) result.push_back(v);
    }
    return result;
  }

  /// Moves each vertex to the mean of its neighbours, but not out of the tolerance.
  void smooth(const std::vector<int>& vertices) {
    std::vector<Vec3> places;
    for (const int v : vertices) {
      const Vec3 offset = neighbour_mean(v) - former_[v];
      const double length = offset.norm();
      places.push_back(former_[v] + (length > tolerance_ ? tolerance_ / length : 1.0) * offset);
    }
    for (std::size_t i = 0; i < vertices.size(); ++i) surface_.points[vertices[i]] = places[i];
  }

 private:
  Vec3 neighbour_mean(int v) const {
    Vec3 sum = Vec3::Zero();
    int count = 0;
    const int first = mesh_.outgoing(v);
    int h = first;
    do {
      sum += surface_.points[mesh_.tip(h)];
      ++count;
      h = mesh_.rotate(h);
    } while (h != first);
    return sum / count;
  }

  TriangleSurface& surface_;
  std::vector<Vec3> former_;
  double tolerance_;
  Connectivity mesh_;
};

bool all_have_area(const TriangleSurface& surface) {
  for (int f = 0; f < static_cast<int>(surface.triangles.size()); ++f) {
    if (!has_area(surface, f)) return false;
  }
  return true;
}

}  // namespace

Outcome remesh_hopeless(State& state, const double* edge, double tolerance) {
  if (edge != nullptr) check_edge(state.surface, *edge);
  const double share = poor_share(state.surface);
  const bool is_hopeless = share > greatest_poor_share;
  if (!all_have_area(state.surface) || (edge == nullptr && !is_hopeless)) return {};
  const double length = edge != nullptr ? *edge : default_edge(state.surface);
  const double growth = pieces(state.surface, length);
  const auto count = static_cast<double>(state.surface.triangles.size());
  const bool is_quick = (growth <= greatest_growth || growth * count <= few_triangles) &&
                        longest_side(state.surface) <= greatest_side * length;
  if (edge == nullptr && !is_quick) return {};
  TriangleSurface remeshed = remesh(state.surface, length);
  const double moved = surface_distance(state.surface, remeshed);
  if (!(moved <= tolerance)) {
    if (edge == nullptr) return {};
    throw UsageError(fmt::format(
        "remeshing with the edge length {:.4g} would move the surface by {:.3g}, more than the "
        "tolerance of {:.3g}: ask for a shorter edge or a larger tolerance",
        length, moved, tolerance));
  }
  Outcome outcome;
  outcome.places.push_back(centroid(state.surface, 0));
  outcome.text =
      fmt::format("the surface was remeshed with the edge length {:.4g}, from {} to {} triangles",
                  length, state.surface.triangles.size(), remeshed.triangles.size());
  if (is_hopeless) {
    outcome.text += fmt::format("; {:.0f} % of its area was in triangles of quality below {}",
                                100.0 * share, poor_quality);
  }
  state.origin.assign(remeshed.triangles.size(), -1);
  state.surface = std::move(remeshed);
  return outcome;
}

Outcome resolve_intersections(State& state, double tolerance, bool& is_free) {
  is_free = false;
  if (!all_have_area(state.surface)) return {};
  auto pairs = self_intersections(state.surface);
  is_free = pairs.empty();
  if (is_free) return {};
  Outcome outcome;
  for (const auto& pair : pairs) outcome.places.push_back(centroid(state.surface, pair.first));
  Smoother smoother(state.surface, tolerance);
  for (int round = 0; round < smoothing_rounds && !pairs.empty(); ++round) {
    const std::vector<int> region = smoother.region(pairs, 1 + round / 2);
    for (int step = 0; step < smoothing_steps; ++step) smoother.smooth(region);
    pairs = self_intersections(state.surface);
  }
  is_free = pairs.empty() && all_have_area(state.surface);
  if (!is_free) return {};
  outcome.text =
      fmt::format("the surface crossed or touched itself at {} and was smoothed there",
                  counted(outcome.places.size(), "pair of triangles", "pairs of triangles"));
  return outcome;
}

}  // namespace hexwall::repair
