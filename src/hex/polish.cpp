#include "hex/polish.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "hex/column_search.h"
#include "quad/quality.h"

namespace hexwall {
namespace {

// Goals: well above what is required (0.4, 0.2 and 0), so that reaching them nearly is good enough.
constexpr double wanted_quad_jacobian = 0.5;
constexpr double wanted_hex_jacobian = 0.3;
constexpr double wanted_face_split = 0.15;
// Among places that meet the goals, those with squarer quads are taken.
constexpr double skew_weight = 0.02;
// A move may not take what a thinner wall would need, should the goals be out of reach.
constexpr double enough_thin_quality = 0.4;
// Nor may edges fall below this share of the shortest one around their end at first: where the wall
// is too thick for the place, quads would close up for what they cannot reach.
constexpr double least_share_of_edge = 0.3;
constexpr double smallest_step = 0.02;
constexpr int most_sweeps = 60;

double square(double x) {
  return x * x;
}

/// Brings the columns that fall short of the goals up to them.
class Mender {
 public:
  /// \param columns #Q as they are.
  Mender(ColumnSearch& search, std::span<const ColumnQuality> columns)
      : search_(search),
        is_hopeless_(hopeless_columns(columns)),
        step_(search.quads().points.size(), 1.0) {
    shortfall_.reserve(columns.size());
    for (int q = 0; q < static_cast<int>(columns.size()); ++q) {
      shortfall_.push_back(shortfall(q, columns[q].scaled_jacobian, columns[q].face_split));
    }
    for (int v = 0; v < static_cast<int>(step_.size()); ++v) {
      least_edge_.push_back(least_share_of_edge * search.shortest_edge(v));
    }
  }

  /// \param moved #V set to 1 where a vertex is moved or turned.
  void run(std::vector<char>& moved, PolishResult& result) {
    result.columns_before = count_short();
    for (int sweep = 0; sweep < most_sweeps; ++sweep) {
      bool changed = false;
      for (const int v : vertices_of_short_columns()) {
        if (improve(v)) {
          moved[v] = 1;
          changed = true;
        } else {
          step_[v] *= 0.5;
          changed = changed || step_[v] > smallest_step;
        }
      }
      if (!changed) break;
    }
    result.columns_after = count_short();
  }

 private:
  int count_short() const {
    return static_cast<int>(
        std::count_if(shortfall_.begin(), shortfall_.end(), [](double s) { return s > 0.0; }));
  }

  double shortfall(int q, double hex_jacobian, double split) const {
    return square(std::max(0.0, wanted_quad_jacobian - scaled_jacobian(search_.column(q).base))) +
           square(std::max(0.0, wanted_hex_jacobian - hex_jacobian)) +
           (is_hopeless_[q] != 0 ? 0.0 : square(std::max(0.0, wanted_face_split - split)));
  }

  double shortfall(int q) const {
    const Column c = search_.column(q);
    const double split = is_hopeless_[q] != 0 ? 0.0 : face_split(c, search_.levels());
    return shortfall(q, scaled_jacobian(c, search_.levels()), split);
  }

  // Vertices of short columns that may still move, in order of their numbers.
  std::vector<int> vertices_of_short_columns() const {
    std::vector<int> vertices;
    for (std::size_t q = 0; q < shortfall_.size(); ++q) {
      if (shortfall_[q] <= 0.0) continue;
      for (const int v : search_.quads().quads[q]) {
        if (search_.quads().loop_of_vertex[v] < 0 && step_[v] > smallest_step) {
          vertices.push_back(v);
        }
      }
    }
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    return vertices;
  }

  // Summed up as far as it stays below `limit`.
  double cost_around(int v, double limit) const {
    double sum = 0.0;
    for (const int q : search_.columns_around(v)) {
      sum += shortfall(q) + skew_weight * skew(search_.column(q));
      if (sum >= limit) break;
    }
    return sum;
  }

  // Least quality around v in the limit of a thin wall, as far as it matters.
  double thin_quality_around(int v) const {
    double least = enough_thin_quality;
    for (const int q : search_.columns_around(v)) {
      least = std::min(least, flat_quality(search_.column(q)));
    }
    return least;
  }

  bool improve(int v) {
    const double thin_quality = thin_quality_around(v);
    const bool improved = search_.improve(
        v, step_[v], [this](int w, double limit) { return cost_around(w, limit); },
        [&](int w) {
          return search_.shortest_edge(w) >= least_edge_[w] &&
                 thin_quality_around(w) >= thin_quality;
        });
    if (!improved) return false;
    for (const int q : search_.columns_around(v)) shortfall_[q] = shortfall(q);
    return true;
  }

  ColumnSearch& search_;
  std::vector<char> is_hopeless_;   // #Q faces between layers are not asked to be split
  std::vector<double> shortfall_;   // #Q
  std::vector<double> step_;        // #V
  std::vector<double> least_edge_;  // #V
};

}  // namespace

PolishResult polish(QuadMesh& quads, std::vector<SurfacePoint>& places,
                    std::vector<Vec3>& directions, const SurfaceProjector& projector,
                    const WallShape& shape, std::span<const ColumnQuality> columns) {
  ColumnSearch search(quads, places, directions, projector, shape);
  PolishResult result;
  std::vector<char> moved(quads.points.size(), 0);
  Mender(search, columns).run(moved, result);
  result.moved = static_cast<int>(std::count(moved.begin(), moved.end(), 1));
  return result;
}

}  // namespace hexwall
