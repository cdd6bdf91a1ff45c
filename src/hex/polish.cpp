#include "hex/polish.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "core/parallel.h"
#include "quad/quality.h"

namespace hexwall {
namespace {

struct Goals {
  double quad_jacobian;
  double hex_jacobian;
  double face_split;
};

// First goals: well above what is required (0.4, 0.2 and 0), so that reaching them nearly is good
// enough.
constexpr Goals first_goals{0.5, 0.3, 0.15};
// Then for fewer hexes that are the worst, as far as no faces are lost to OpenFOAM. At a zero of
// the form eight quads meet, whose corners have a scaled Jacobian of 0.71 on a flat surface.
constexpr Goals further_goals{0.68, 0.66, 0.15};
// Faces that are split worse than this are so because the quads are warped by more than the layers
// are high: only smaller quads or higher layers mend that.
constexpr double hopeless_face_split = -4.0;
// Beyond this share of columns with faces that cannot be split, no polishing of a few mends them.
constexpr double most_badly_split = 0.02;
// Among places that meet the goals, those with squarer quads are taken.
constexpr double skew_weight = 0.02;
// A move may not take what a thinner wall would need, should the goals be out of reach.
constexpr double enough_thin_quality = 0.4;
// Steps of the search: relative to the shortest edge for moves, in radians for tilts.
constexpr double first_move = 0.3;
constexpr double first_tilt = 0.3;
constexpr double smallest_step = 0.02;
constexpr int step_directions = 8;
constexpr int most_sweeps = 60;

double square(double x) {
  return x * x;
}

class Polisher {
 public:
  Polisher(QuadMesh& quads, std::vector<SurfacePoint>& places, std::vector<Vec3>& directions,
           const SurfaceProjector& projector, const WallShape& shape)
      : quads_(quads),
        places_(places),
        directions_(directions),
        projector_(projector),
        shape_(shape),
        first_quad_(quads.points.size() + 1, 0),
        quads_of_vertex_(4 * quads.quads.size()),
        is_hopeless_(quads.quads.size(), 0),
        has_face_tets_(quads.quads.size(), 0),
        shortfall_(quads.quads.size()),
        step_(quads.points.size(), 1.0),
        moved_(quads.points.size(), 0) {
    for (const auto& quad : quads.quads) {
      for (const int v : quad) ++first_quad_[v + 1];
    }
    for (std::size_t v = 0; v < quads.points.size(); ++v) first_quad_[v + 1] += first_quad_[v];
    std::vector<int> next(first_quad_.begin(), first_quad_.end() - 1);
    for (std::size_t q = 0; q < quads.quads.size(); ++q) {
      for (const int v : quads.quads[q]) quads_of_vertex_[next[v]++] = static_cast<int>(q);
    }
  }

  PolishResult run() {
    PolishResult result;
    find_hopeless();
    aim_for(first_goals);
    result.columns_before = count_short();
    search();
    result.columns_after = count_short();
    aim_for(further_goals);
    find_face_tets();
    search();
    result.moved = static_cast<int>(std::count(moved_.begin(), moved_.end(), 1));
    return result;
  }

 private:
  // Columns whose faces between layers are not asked to be split: those that are warped far too
  // much for their layers, and all if many are, as in a wall that is too thin for the size of its
  // quads.
  void find_hopeless() {
    std::vector<char> is_short(is_hopeless_.size());
    parallel_for(is_hopeless_.size(), [&](std::size_t q) {
      const double split =
          column_quality(column(static_cast<int>(q)), shape_.plan.levels).face_split;
      is_hopeless_[q] = split < hopeless_face_split ? 1 : 0;
      is_short[q] = split < 0.0 ? 1 : 0;
    });
    const auto short_count = static_cast<double>(std::count(is_short.begin(), is_short.end(), 1));
    if (short_count <= most_badly_split * static_cast<double>(is_short.size())) return;
    std::fill(is_hopeless_.begin(), is_hopeless_.end(), 1);
  }

  void aim_for(const Goals& goals) {
    goals_ = goals;
    parallel_for(shortfall_.size(),
                 [&](std::size_t q) { shortfall_[q] = shortfall(static_cast<int>(q)); });
    std::fill(step_.begin(), step_.end(), 1.0);
  }

  void find_face_tets() {
    parallel_for(has_face_tets_.size(), [&](std::size_t q) {
      has_face_tets_[q] = has_face_tets(column(static_cast<int>(q)), shape_.plan.levels) ? 1 : 0;
    });
  }

  void search() {
    for (int sweep = 0; sweep < most_sweeps; ++sweep) {
      bool changed = false;
      for (const int v : vertices_of_short_columns()) changed = improve(v) || changed;
      if (!changed) break;
    }
  }

  int count_short() const {
    return static_cast<int>(
        std::count_if(shortfall_.begin(), shortfall_.end(), [](double s) { return s > 0.0; }));
  }

  Column column(int q) const { return column_of(quads_, q, directions_, shape_); }

  double shortfall(int q) const {
    const Column c = column(q);
    const ColumnQuality quality = column_quality(c, shape_.plan.levels);
    return square(std::max(0.0, goals_.quad_jacobian - scaled_jacobian(c.base))) +
           square(std::max(0.0, goals_.hex_jacobian - quality.scaled_jacobian)) +
           (is_hopeless_[q] != 0 ? 0.0
                                 : square(std::max(0.0, goals_.face_split - quality.face_split)));
  }

  // Vertices of short columns that may still move, in order of their numbers.
  std::vector<int> vertices_of_short_columns() const {
    std::vector<int> vertices;
    for (std::size_t q = 0; q < shortfall_.size(); ++q) {
      if (shortfall_[q] <= 0.0) continue;
      for (const int v : quads_.quads[q]) {
        if (quads_.loop_of_vertex[v] < 0 && step_[v] > smallest_step) vertices.push_back(v);
      }
    }
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    return vertices;
  }

  double cost_around(int v) const {
    double sum = 0.0;
    for (int i = first_quad_[v]; i < first_quad_[v + 1]; ++i) {
      const int q = quads_of_vertex_[i];
      sum += shortfall(q) + skew_weight * skew(q);
    }
    return sum;
  }

  // Sum of the squared cosines of a quad's corner angles.
  double skew(int q) const {
    const auto p = corners_of(quads_, q);
    double sum = 0.0;
    for (int k = 0; k < 4; ++k) {
      sum += square((p[(k + 1) % 4] - p[k]).normalized().dot((p[(k + 3) % 4] - p[k]).normalized()));
    }
    return sum;
  }

  // Least quality around v in the limit of a thin wall, as far as it matters.
  double thin_quality_around(int v) const {
    double least = enough_thin_quality;
    for (int i = first_quad_[v]; i < first_quad_[v + 1]; ++i) {
      least = std::min(least, flat_quality(column(quads_of_vertex_[i])));
    }
    return least;
  }

  // Whether a column around v that had face tets has none now.
  bool loses_face_tets(int v) const {
    for (int i = first_quad_[v]; i < first_quad_[v + 1]; ++i) {
      const int q = quads_of_vertex_[i];
      if (has_face_tets_[q] != 0 && !has_face_tets(column(q), shape_.plan.levels)) return true;
    }
    return false;
  }

  double shortest_edge(int v) const {
    double shortest = std::numeric_limits<double>::max();
    for (int i = first_quad_[v]; i < first_quad_[v + 1]; ++i) {
      const auto& quad = quads_.quads[quads_of_vertex_[i]];
      for (int k = 0; k < 4; ++k) {
        if (quad[k] != v && quad[(k + 1) % 4] != v) continue;
        const Vec3& a = quads_.points[quad[k]];
        shortest = std::min(shortest, (a - quads_.points[quad[(k + 1) % 4]]).norm());
      }
    }
    return shortest;
  }

  // Takes the best of a ring of moves and a ring of tilts; halves the steps where none helps.
  bool improve(int v) {
    const SurfacePoint place = places_[v];
    const Vec3 direction = directions_[v];
    const Vec3 e1 = direction.unitOrthogonal();
    const Vec3 e2 = direction.cross(e1);
    const double move = first_move * step_[v] * shortest_edge(v);
    const double tilt = first_tilt * step_[v];
    const double thin_quality = thin_quality_around(v);
    double best = cost_around(v) * (1.0 - 1e-6);  // a gain below that is not worth a sweep
    SurfacePoint best_place = place;
    Vec3 best_direction = direction;
    bool found = false;
    for (int i = 0; i < 2 * step_directions; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / step_directions;
      const Vec3 tangent = std::cos(angle) * e1 + std::sin(angle) * e2;
      const bool moves = i < step_directions;
      set(v, moves ? projector_.project(place.position + move * tangent, place.face) : place,
          moves ? direction : (direction + tilt * tangent).normalized());
      const double cost = cost_around(v);
      if (cost >= best || thin_quality_around(v) < thin_quality || loses_face_tets(v)) continue;
      best = cost;
      best_place = places_[v];
      best_direction = directions_[v];
      found = true;
    }
    set(v, best_place, best_direction);
    if (found) {
      accept(v);
    } else {
      step_[v] *= 0.5;
    }
    return found || step_[v] > smallest_step;
  }

  void set(int v, const SurfacePoint& place, const Vec3& direction) {
    places_[v] = place;
    quads_.points[v] = place.position;
    directions_[v] = direction;
  }

  void accept(int v) {
    moved_[v] = 1;
    for (int i = first_quad_[v]; i < first_quad_[v + 1]; ++i) {
      shortfall_[quads_of_vertex_[i]] = shortfall(quads_of_vertex_[i]);
    }
  }

  QuadMesh& quads_;
  std::vector<SurfacePoint>& places_;
  std::vector<Vec3>& directions_;
  const SurfaceProjector& projector_;
  const WallShape& shape_;
  std::vector<int> first_quad_, quads_of_vertex_;
  std::vector<char> is_hopeless_;    // #Q faces between layers are not asked to be split
  std::vector<char> has_face_tets_;  // #Q
  std::vector<double> shortfall_;
  Goals goals_ = first_goals;
  std::vector<double> step_;
  std::vector<char> moved_;
};

}  // namespace

PolishResult polish(QuadMesh& quads, std::vector<SurfacePoint>& places,
                    std::vector<Vec3>& directions, const SurfaceProjector& projector,
                    const WallShape& shape) {
  return Polisher(quads, places, directions, projector, shape).run();
}

}  // namespace hexwall
