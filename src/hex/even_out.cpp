#include "hex/even_out.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

#include "core/parallel.h"
#include "hex/column_search.h"

namespace hexwall {
namespace {

// Columns with hexes below this are evened out with the rings of vertices around them, unless that
// is much of the mesh.
constexpr double poor_jacobian = 0.62;
constexpr int rings_around_poor = 3;
constexpr int rings_around_worst = 2;
constexpr double most_evened = 0.2;
// The very worst are those within this of the worst.
constexpr double worst_range = 0.06;
// A face that is just split counts like a scaled Jacobian of one less this.
constexpr double least_split_weight = 0.45;
constexpr double greatest_split_weight = 1.0;
// Powers of what corners lack, in number of squarings.
constexpr int first_squarings = 4;
constexpr int most_squarings = 7;
// Keeps good quads square: with the first power it weighs like corners that lack about 0.37.
constexpr double first_skew_weight = 1e-7;
// Vertices stay, for the while, where the corners around them lack less than about 0.29.
constexpr double first_good_cost = 2e-9;
// No edge gets shorter than this share of the shortest one around its end.
constexpr double least_share_of_edge = 0.65;
// Columns do not get narrower at the skins than this share, or than they were: beyond, they pinch
// and meet each other.
constexpr double enough_width = 0.15;
// Steps start with this, or half of it where the power was raised, and are halved after so many
// sweeps, or where a sweep leaves more than this share of the cost.
constexpr double first_step = 0.5;
constexpr int most_halvings = 4;
constexpr int most_sweeps = 12;
constexpr double enough_decrease = 0.8;

/// Which columns are evened out, and what counts.
struct Goals {
  double poor_jacobian;
  int rings;  ///< around them
  double split_weight;
  int squarings;         ///< of the first power
  bool keeps_face_tets;  ///< no face is lost to OpenFOAM
};

/// Minimises the sum of a high power of what the corners of the hexes lack, around poor columns.
class Evener {
 public:
  Evener(ColumnSearch& search, const Goals& goals, const EvenOutOptions& options)
      : search_(search),
        columns_(options.columns),
        is_hopeless_(hopeless_columns(options.columns)),
        goals_(goals),
        least_edge_(options.least_edge.begin(), options.least_edge.end()) {}

  /// \return vertices moved or turned.
  int run(int last_squarings) {
    vertices_ = vertices_around_poor_columns();
    const auto count = static_cast<double>(least_edge_.size());
    if (static_cast<double>(vertices_.size()) > most_evened * count) return 0;
    least_width_.resize(least_edge_.size());
    for (const int v : vertices_) {
      least_edge_[v] = std::max(least_share_of_edge * search_.shortest_edge(v), least_edge_[v]);
      least_width_[v] = search_.width_around(v, enough_width);
    }
    find_vertices_apart();
    moved_.assign(least_edge_.size(), 0);
    cost_.resize(least_edge_.size());
    for (int squarings = goals_.squarings; squarings <= last_squarings; ++squarings) {
      squarings_ = squarings;
      minimise(squarings == first_squarings ? first_step : 0.5 * first_step);
    }
    return static_cast<int>(std::count(moved_.begin(), moved_.end(), 1));
  }

 private:
  void minimise(double step) {
    for (int halving = 0; halving < most_halvings; ++halving, step *= 0.5) {
      double before = std::numeric_limits<double>::max();
      for (int i = 0; i < most_sweeps; ++i) {
        const double cost = sweep(step);
        if (cost > enough_decrease * before) break;
        before = cost;
      }
    }
  }

  double sweep(double step) {
    const double good = squared(first_good_cost, squarings_ - first_squarings);
    search_.turn_rings();
    for (const std::vector<int>& apart : vertices_apart_) {
      parallel_tasks(apart.size(), [&](std::size_t i) {
        const int v = apart[i];
        cost_[v] = cost_around(v);
        if (cost_[v] > good && improve(v, step)) moved_[v] = 1;
      });
    }
    return std::accumulate(vertices_.begin(), vertices_.end(), 0.0,
                           [this](double sum, int v) { return sum + cost_[v]; });
  }

  // Sorts the vertices into classes in which no two have a quad in common, so that none sees
  // another one of its class move.
  void find_vertices_apart() {
    std::vector<int> number(least_edge_.size(), -1);
    for (const int v : vertices_) {
      std::vector<char> is_taken(vertices_apart_.size() + 1, 0);
      for (const int q : search_.columns_around(v)) {
        for (const int w : search_.quads().quads[q]) {
          if (number[w] >= 0) is_taken[number[w]] = 1;
        }
      }
      number[v] =
          static_cast<int>(std::find(is_taken.begin(), is_taken.end(), 0) - is_taken.begin());
      vertices_apart_.resize(
          std::max(vertices_apart_.size(), static_cast<std::size_t>(number[v]) + 1));
      vertices_apart_[number[v]].push_back(v);
    }
  }

  std::vector<int> vertices_around_poor_columns() const {
    const auto& quads = search_.quads().quads;
    std::vector<char> in_region(quads.size());
    for (std::size_t q = 0; q < quads.size(); ++q) {
      const bool is_poor = columns_[q].scaled_jacobian < goals_.poor_jacobian ||
                           (is_hopeless_[q] == 0 && columns_[q].face_tet_margin <= 0.0);
      in_region[q] = is_poor ? 1 : 0;
    }
    std::vector<char> near(search_.quads().points.size(), 0);
    for (int ring = 0; ring <= goals_.rings; ++ring) {
      for (std::size_t q = 0; q < quads.size(); ++q) {
        if (in_region[q] == 0) continue;
        for (const int v : quads[q]) near[v] = 1;
      }
      for (std::size_t q = 0; q < quads.size(); ++q) {
        const auto is_near = [&](int v) { return near[v] != 0; };
        if (std::any_of(quads[q].begin(), quads[q].end(), is_near)) in_region[q] = 1;
      }
    }
    std::vector<int> vertices;
    for (std::size_t v = 0; v < near.size(); ++v) {
      if (near[v] != 0 && search_.quads().loop_of_vertex[v] < 0) {
        vertices.push_back(static_cast<int>(v));
      }
    }
    return vertices;
  }

  // Summed up as far as it stays below `limit`: most trials are given up early.
  double cost_around(int v, double limit = std::numeric_limits<double>::infinity()) const {
    const double skew_weight = squared(first_skew_weight, squarings_ - first_squarings);
    double sum = 0.0;
    for (const int q : search_.columns_around(v)) {
      const Column column = search_.column(q);
      sum += corner_deficit(column, search_.levels(), squarings_) + skew_weight * skew(column);
      if (sum >= limit) return sum;
      if (is_hopeless_[q] != 0) continue;
      const double split = face_split(column, search_.levels());
      sum += squared(goals_.split_weight * (1.0 - split), squarings_);
      if (sum >= limit) return sum;
    }
    return sum;
  }

  bool improve(int v, double step) {
    return search_.improve(
        v, step, [this](int w, double limit) { return cost_around(w, limit); },
        [this](int w) {
          return search_.shortest_edge(w) >= least_edge_[w] &&
                 search_.width_around(w, enough_width) >= least_width_[w] &&
                 (!goals_.keeps_face_tets || have_face_tets(w));
        });
  }

  bool have_face_tets(int v) const {
    const auto columns = search_.columns_around(v);
    return std::all_of(columns.begin(), columns.end(), [this](int q) {
      return is_hopeless_[q] != 0 || has_face_tets(search_.column(q), search_.levels());
    });
  }

  ColumnSearch& search_;
  std::span<const ColumnQuality> columns_;  // before anything is moved
  std::vector<char> is_hopeless_;
  Goals goals_;
  int squarings_ = first_squarings;
  std::vector<double> least_edge_;   // #V
  std::vector<double> least_width_;  // #V
  std::vector<int> vertices_;        // that may be moved or turned
  std::vector<std::vector<int>> vertices_apart_;
  std::vector<char> moved_;   // #V
  std::vector<double> cost_;  // #V, around each one when it was looked at last
};

}  // namespace

int even_out(QuadMesh& quads, std::vector<SurfacePoint>& places, std::vector<Vec3>& directions,
             const SurfaceProjector& projector, const WallShape& shape,
             const EvenOutOptions& options) {
  ColumnSearch search(quads, places, directions, projector, shape);
  const double split_weight =
      least_split_weight + options.face_tets * (greatest_split_weight - least_split_weight);
  const Goals goals{poor_jacobian, rings_around_poor, split_weight, first_squarings, false};
  return Evener(search, goals, options).run(first_squarings);
}

int even_out_worst(QuadMesh& quads, std::vector<SurfacePoint>& places,
                   std::vector<Vec3>& directions, const SurfaceProjector& projector,
                   const WallShape& shape, const EvenOutOptions& options) {
  ColumnSearch search(quads, places, directions, projector, shape);
  const double poor = std::min(poor_jacobian, least_scaled_jacobian(options.columns) + worst_range);
  const Goals goals{poor, rings_around_worst, least_split_weight, first_squarings + 1, true};
  return Evener(search, goals, options).run(most_squarings);
}

}  // namespace hexwall
