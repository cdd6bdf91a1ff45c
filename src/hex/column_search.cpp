#include "hex/column_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Geometry>

#include "core/cancel.h"

namespace hexwall {
namespace {

// Widest steps: relative to the shortest edge for moves, in radians for tilts.
constexpr double widest_move = 0.3;
constexpr double widest_tilt = 0.3;
constexpr int step_directions = 8;
// A smaller gain is not worth a step.
constexpr double least_gain = 1e-6;

}  // namespace

ColumnSearch::ColumnSearch(QuadMesh& quads, std::vector<SurfacePoint>& places,
                           std::vector<Vec3>& directions, const SurfaceProjector& projector,
                           const WallShape& shape)
    : quads_(quads),
      places_(places),
      directions_(directions),
      projector_(projector),
      shape_(shape),
      first_quad_(quads.points.size() + 1, 0),
      quads_of_vertex_(4 * quads.quads.size()) {
  for (const auto& quad : quads.quads) {
    for (const int v : quad) ++first_quad_[v + 1];
  }
  for (std::size_t v = 0; v < quads.points.size(); ++v) first_quad_[v + 1] += first_quad_[v];
  std::vector<int> next(first_quad_.begin(), first_quad_.end() - 1);
  for (std::size_t q = 0; q < quads.quads.size(); ++q) {
    for (const int v : quads.quads[q]) quads_of_vertex_[next[v]++] = static_cast<int>(q);
  }
}

bool ColumnSearch::improve(int v, double step,
                           const std::function<double(int, double)>& cost_around,
                           const std::function<bool(int)>& is_allowed) {
  throw_if_cancelled();
  const SurfacePoint place = places_[v];
  const Vec3 direction = directions_[v];
  const Vec3 e1 = direction.unitOrthogonal();
  const Vec3 e2 = direction.cross(e1);
  const double move = widest_move * step * shortest_edge(v);
  const double tilt = widest_tilt * step;
  double best = cost_around(v, std::numeric_limits<double>::infinity()) * (1.0 - least_gain);
  SurfacePoint best_place = place;
  Vec3 best_direction = direction;
  bool found = false;
  for (int i = 0; i < 2 * step_directions; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / step_directions + turn_;
    const Vec3 tangent = std::cos(angle) * e1 + std::sin(angle) * e2;
    const bool moves = i < step_directions;
    set(v, moves ? projector_.project(place.position + move * tangent, place.face) : place,
        moves ? direction : (direction + tilt * tangent).normalized());
    const double cost = cost_around(v, best);
    if (cost >= best || !is_allowed(v)) continue;
    best = cost;
    best_place = places_[v];
    best_direction = directions_[v];
    found = true;
  }
  set(v, best_place, best_direction);
  return found;
}

double ColumnSearch::shortest_edge(int v) const {
  double shortest = std::numeric_limits<double>::max();
  for (const int q : columns_around(v)) {
    const auto& quad = quads_.quads[q];
    for (int k = 0; k < 4; ++k) {
      if (quad[k] != v && quad[(k + 1) % 4] != v) continue;
      const Vec3& a = quads_.points[quad[k]];
      shortest = std::min(shortest, (a - quads_.points[quad[(k + 1) % 4]]).norm());
    }
  }
  return shortest;
}

double ColumnSearch::width_around(int v, double most) const {
  double least = most;
  for (const int q : columns_around(v)) {
    least = std::min(least, width_at_skins(column(q), levels()));
  }
  return least;
}

void ColumnSearch::set(int v, const SurfacePoint& place, const Vec3& direction) {
  places_[v] = place;
  quads_.points[v] = place.position;
  directions_[v] = direction;
}

}  // namespace hexwall
