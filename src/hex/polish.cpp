#include "hex/polish.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Geometry>

#include "core/parallel.h"
#include "hex/column_search.h"
#include "quad/quality.h"

namespace hexwall {
namespace {

// Goals: well above what is required (0.4, 0.2 and 0), so that reaching them nearly is good enough.
constexpr double wanted_quad_jacobian = 0.5;
constexpr double wanted_hex_jacobian = 0.3;
constexpr double wanted_face_split = 0.15;
// Faces that are split worse than this are so because the quads are warped by more than the layers
// are high: only smaller quads or higher layers mend that.
constexpr double hopeless_face_split = -4.0;
// Beyond this share of columns with faces that cannot be split, no polishing of a few mends them.
constexpr double most_badly_split = 0.02;
// Among places that meet the goals, those with squarer quads are taken.
constexpr double skew_weight = 0.02;
// A move may not take what a thinner wall would need, should the goals be out of reach.
constexpr double enough_thin_quality = 0.4;
constexpr double smallest_step = 0.02;
constexpr int most_sweeps = 60;

// Evening out: columns with hexes below this are evened out with the rings of vertices around them,
// unless that is much of the mesh.
constexpr double poor_jacobian = 0.62;
constexpr int even_rings = 3;
constexpr double most_evened = 0.2;
// A face that is just split counts like a scaled Jacobian of one less this.
constexpr double least_split_weight = 0.45;
constexpr double greatest_split_weight = 1.0;
// Keeps good quads square: weighs like corners with a scaled Jacobian of about 0.7.
constexpr double even_skew_weight = 1e-7;
// No edge gets shorter than this share of the shortest one around its end.
constexpr double least_shortening = 0.8;
// Vertices stay, for the while, where the corners around them are better than about 0.72.
constexpr double good_cost = 2e-9;
constexpr double first_even_step = 0.5;
constexpr int even_halvings = 5;
// Steps are halved after so many sweeps, or where a sweep leaves more than this share of the cost.
constexpr int most_even_sweeps = 12;
constexpr double enough_decrease = 0.9;

double square(double x) {
  return x * x;
}

double sixteenth_power(double x) {
  return square(square(square(square(x))));
}

// Sum of the squared cosines of the corner angles of a column's base.
double skew(const Column& column) {
  const auto& p = column.base;
  double sum = 0.0;
  for (int k = 0; k < 4; ++k) {
    sum += square((p[(k + 1) % 4] - p[k]).normalized().dot((p[(k + 3) % 4] - p[k]).normalized()));
  }
  return sum;
}

/// Columns whose faces between layers are not asked to be split: those that are warped far too much
/// for their layers, and all if many are, as in a wall that is too thin for the size of its quads.
std::vector<char> hopeless_columns(const ColumnSearch& search) {
  std::vector<char> is_hopeless(search.quads().quads.size());
  std::vector<char> is_short(is_hopeless.size());
  parallel_for(is_hopeless.size(), [&](std::size_t q) {
    const Column column = search.column(static_cast<int>(q));
    const double split = face_split(column, search.levels());
    is_hopeless[q] = split < hopeless_face_split ? 1 : 0;
    is_short[q] = split < 0.0 ? 1 : 0;
  });
  const auto short_count = static_cast<double>(std::count(is_short.begin(), is_short.end(), 1));
  if (short_count > most_badly_split * static_cast<double>(is_short.size())) {
    std::fill(is_hopeless.begin(), is_hopeless.end(), 1);
  }
  return is_hopeless;
}

/// Brings the columns that fall short of the goals up to them.
class Mender {
 public:
  Mender(ColumnSearch& search, std::vector<char> is_hopeless)
      : search_(search),
        is_hopeless_(std::move(is_hopeless)),
        shortfall_(search.quads().quads.size()),
        step_(search.quads().points.size(), 1.0) {}

  /// \param moved #V set to 1 where a vertex is moved or turned.
  void run(std::vector<char>& moved, PolishResult& result) {
    parallel_for(shortfall_.size(),
                 [&](std::size_t q) { shortfall_[q] = shortfall(static_cast<int>(q)); });
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

  double shortfall(int q) const {
    const Column c = search_.column(q);
    return square(std::max(0.0, wanted_quad_jacobian - scaled_jacobian(c.base))) +
           square(std::max(0.0, wanted_hex_jacobian - scaled_jacobian(c, search_.levels()))) +
           (is_hopeless_[q] != 0
                ? 0.0
                : square(std::max(0.0, wanted_face_split - face_split(c, search_.levels()))));
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

  double cost_around(int v) const {
    double sum = 0.0;
    for (const int q : search_.columns_around(v))
      sum += shortfall(q) + skew_weight * skew(search_.column(q));
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
        v, step_[v], [this](int w) { return cost_around(w); },
        [&](int w) { return thin_quality_around(w) >= thin_quality; });
    if (!improved) return false;
    for (const int q : search_.columns_around(v)) shortfall_[q] = shortfall(q);
    return true;
  }

  ColumnSearch& search_;
  std::vector<char> is_hopeless_;  // #Q faces between layers are not asked to be split
  std::vector<double> shortfall_;
  std::vector<double> step_;
};

/// Raises the worst hexes further by evening out their surroundings, as far as no faces are lost to
/// OpenFOAM: minimises the sum of a high power of what the corners of the hexes lack.
class Evener {
 public:
  Evener(ColumnSearch& search, std::vector<char> is_hopeless, double split_weight)
      : search_(search),
        is_hopeless_(std::move(is_hopeless)),
        split_weight_(split_weight),
        least_edge_(search.quads().points.size(), 0.0) {}

  void run(std::vector<char>& moved) {
    const std::vector<int> vertices = vertices_around_poor_columns();
    if (static_cast<double>(vertices.size()) > most_evened * static_cast<double>(moved.size())) {
      return;
    }
    for (const int v : vertices) least_edge_[v] = least_shortening * search_.shortest_edge(v);
    double step = first_even_step;
    for (int halving = 0; halving < even_halvings; ++halving, step *= 0.5) {
      double before = std::numeric_limits<double>::max();
      for (int i = 0; i < most_even_sweeps; ++i) {
        const double cost = sweep(vertices, step, moved);
        if (cost > enough_decrease * before) break;
        before = cost;
      }
    }
  }

 private:
  double sweep(const std::vector<int>& vertices, double step, std::vector<char>& moved) {
    double sum = 0.0;
    search_.turn_rings();
    for (const int v : vertices) {
      const double cost = cost_around(v);
      if (cost > good_cost && improve(v, step)) moved[v] = 1;
      sum += cost;
    }
    return sum;
  }

  std::vector<int> vertices_around_poor_columns() const {
    const auto& quads = search_.quads().quads;
    std::vector<char> in_region(quads.size());
    parallel_for(quads.size(), [&](std::size_t q) {
      const Column column = search_.column(static_cast<int>(q));
      const bool is_poor = scaled_jacobian(column, search_.levels()) < poor_jacobian ||
                           (is_hopeless_[q] == 0 && !has_face_tets(column, search_.levels()));
      in_region[q] = is_poor ? 1 : 0;
    });
    std::vector<char> near(search_.quads().points.size(), 0);
    for (int ring = 0; ring <= even_rings; ++ring) {
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

  double cost_around(int v) const {
    double sum = 0.0;
    for (const int q : search_.columns_around(v)) {
      const Column column = search_.column(q);
      sum += corner_deficit(column, search_.levels()) + even_skew_weight * skew(column);
      if (is_hopeless_[q] != 0) continue;
      sum += sixteenth_power(split_weight_ * (1.0 - face_split(column, search_.levels())));
    }
    return sum;
  }

  bool improve(int v, double step) {
    return search_.improve(
        v, step, [this](int w) { return cost_around(w); },
        [this](int w) { return search_.shortest_edge(w) >= least_edge_[w]; });
  }

  ColumnSearch& search_;
  std::vector<char> is_hopeless_;
  double split_weight_;
  std::vector<double> least_edge_;  // #V where vertices may move
};

}  // namespace

PolishResult polish(QuadMesh& quads, std::vector<SurfacePoint>& places,
                    std::vector<Vec3>& directions, const SurfaceProjector& projector,
                    const WallShape& shape) {
  ColumnSearch search(quads, places, directions, projector, shape);
  PolishResult result;
  std::vector<char> moved(quads.points.size(), 0);
  Mender(search, hopeless_columns(search)).run(moved, result);
  result.moved = static_cast<int>(std::count(moved.begin(), moved.end(), 1));
  return result;
}

int even_out(QuadMesh& quads, std::vector<SurfacePoint>& places, std::vector<Vec3>& directions,
             const SurfaceProjector& projector, const WallShape& shape, double face_tets) {
  ColumnSearch search(quads, places, directions, projector, shape);
  std::vector<char> moved(quads.points.size(), 0);
  Evener(search, hopeless_columns(search),
         least_split_weight + face_tets * (greatest_split_weight - least_split_weight))
      .run(moved);
  return static_cast<int>(std::count(moved.begin(), moved.end(), 1));
}

}  // namespace hexwall
