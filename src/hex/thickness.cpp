#include "hex/thickness.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "core/cancel.h"
#include "core/errors.h"
#include "core/parallel.h"
#include "hex/skewness.h"
#include "hex/skin.h"
#include "quad/quality.h"

namespace hexwall {
namespace {

// OpenFOAM reports faces of skewness above 4.
constexpr double greatest_skewness = 3.6;
// Where this share of the thickness is still too skewed, the quads are, and no thickness mends it.
constexpr double least_ratio_for_skewness = 0.2;
// Thickness shrinks by this factor per round where a column is bad: small enough steps to stay
// near the largest thickness possible, and 1e-3 of the asked one is reached in 40 rounds.
constexpr double shrink_factor = 0.84;
constexpr double least_ratio = 1e-3;
// Of the surface's diagonal: no vessel has a thicker wall, and no branch room for one.
constexpr double greatest_share_of_extent = 0.5;
// Of the greatest coordinate: thinner layers would have heights exact to some digits only.
constexpr double least_share_of_coordinates = 1e-10;
// A change of thickness along the surface by at most this slope keeps the skin smooth.
constexpr double greatest_slope = 0.3;
// Relative: rounding is no violation, or there would be no end on very short edges.
constexpr double slope_tolerance = 1e-12;
// A vertex counts as reduced below this share of the thickness asked for.
constexpr double reduced_below = 0.99;
// Collisions are looked for at this multiple of the thickness: what passes leaves a gap, whichever
// way a reader of the mesh splits the faces of the skin. The core of the lumen needs room.
constexpr double clearance = 1.05;
constexpr double clearance_for_core = 1.25;
// Inside, layers get narrower in a bend and wider over a ridge: for a core that is to be filled,
// edges towards it have a length between these shares of the wall's, unless that takes layers
// thinner than the last of what was asked.
constexpr double least_narrowing = 0.35;
constexpr double greatest_widening = 3.0;
constexpr double least_ratio_for_width = 0.1;

}  // namespace

/// What stays from one fit to the next.
struct ThicknessFitter::Kept {
  Side side;
  bool for_core;  ///< on the inner side
  std::vector<double> levels;
  std::vector<std::array<int, 2>> edges;
  Skin skin;
  Skewness skewness;
  std::vector<ColumnEdge> columns;  ///< #V when Jacobians were computed last
  std::vector<double> jacobian;     ///< #Q scaled Jacobians
};

namespace {

class Fitter {
 public:
  using Kept = ThicknessFitter::Kept;

  Fitter(const QuadMesh& quads, const std::vector<Vec3>& directions, const WallShape& shape,
         Kept& kept)
      : quads_(quads),
        directions_(directions),
        kept_(kept),
        trial_(one_sided(shape)),
        bound_(quads.quads.size()) {
    result_.asked = given();
    for (const auto& [a, b] : kept.edges) {
      const double length = (quads.points[a] - quads.points[b]).norm();
      const double wanted = std::abs(result_.asked[a] - result_.asked[b]);
      room_.push_back(std::max(greatest_slope * length, wanted));
    }
  }

  ThicknessResult run(const std::vector<double>& shares) {
    refuse_absurd_thickness();
    for (std::size_t v = 0; v < shares.size(); ++v) given()[v] *= std::min(1.0, shares[v]);
    if (!shares.empty()) limit_slope();
    find_bounds();
    shrink_bad_columns();
    separate();
    result_.given = given();
    judge();
    return std::move(result_);
  }

 private:
  WallShape one_sided(const WallShape& shape) const {
    WallShape trial = shape;
    (kept_.side == Side::outward ? trial.inward : trial.outward).clear();
    return trial;
  }

  std::vector<double>& given() {
    return kept_.side == Side::outward ? trial_.outward : trial_.inward;
  }

  Column column(std::size_t q) const {
    return column_of(quads_, static_cast<int>(q), directions_, trial_);
  }

  std::string place_of(int v) const {
    const Vec3& at = quads_.points[v];
    return fmt::format("({:.6g}, {:.6g}, {:.6g})", at.x(), at.y(), at.z());
  }

  // Where everything meets everything, there would be no end of collisions; and layers thinner than
  // the last digits of coordinates are none.
  void refuse_absurd_thickness() const {
    Eigen::AlignedBox3d box;
    for (const Vec3& p : quads_.points) box.extend(p);
    const double across = box.diagonal().norm();
    const double farthest = box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).maxCoeff();
    const auto [least, greatest] = std::minmax_element(result_.asked.begin(), result_.asked.end());
    const auto at = [&](auto place) {
      return place_of(static_cast<int>(place - result_.asked.begin()));
    };
    if (*greatest > greatest_share_of_extent * across) {
      throw MeshingError(
          fmt::format("no wall as thick as {:.4g} fits at {}: the surface is {:.4g} across. Is the "
                      "thickness in "
                      "the unit of the surface?",
                      *greatest, at(greatest), across));
    }
    double thinnest = 1.0;  // layer, as a share of all
    for (std::size_t i = 0; i + 1 < kept_.levels.size(); ++i) {
      thinnest = std::min(thinnest, kept_.levels[i + 1] - kept_.levels[i]);
    }
    if (thinnest * *least < least_share_of_coordinates * farthest) {
      throw MeshingError(fmt::format(
          "layers as thin as {:.4g} at {} are lost in rounding at coordinates up to {:.4g}. Is the "
          "thickness in the unit of the surface?",
          thinnest * *least, at(least), farthest));
    }
  }

  // What is wanted of a column: no more than half of what it has in the limit of no thickness.
  void find_bounds() {
    parallel_for(bound_.size(), [&](std::size_t q) {
      bound_[q] = std::min(wanted_scaled_jacobian, 0.5 * flat_quality(column(q)));
    });
    const auto worst = std::min_element(bound_.begin(), bound_.end());
    if (*worst > 0.0) return;
    throw MeshingError(fmt::format(
        "no wall can be extruded at {}: a quad is folded there, which is too large for the "
        "surface, or the surface itself is. Choose a smaller --size, or smooth or remesh the "
        "surface",
        place_of(quads_.quads[worst - bound_.begin()][0])));
  }

  bool is_narrowed_or_widened(std::size_t q) const {
    if (!kept_.for_core) return false;
    const Column c = column(q);
    for (int k = 0; k < 4; ++k) {
      const int j = (k + 1) % 4;
      if (c.inward[k] < least_ratio_for_width * result_.asked[quads_.quads[q][k]]) continue;
      const Vec3 edge = c.base[j] - c.base[k];
      const Vec3 inside = edge - c.inward[j] * c.direction[j] + c.inward[k] * c.direction[k];
      const double length = edge.norm();
      if (inside.dot(edge) < least_narrowing * length * length) return true;
      if (inside.norm() > greatest_widening * length) return true;
    }
    return false;
  }

  // Scaled Jacobians of the columns as they are now.
  void find_jacobians() {
    std::vector<ColumnEdge> columns = column_edges(quads_, directions_, trial_);
    const std::vector<char> changed = changes(kept_.columns, columns);
    kept_.columns = std::move(columns);
    kept_.jacobian.resize(quads_.quads.size());
    parallel_for(kept_.jacobian.size(), [&](std::size_t q) {
      const auto& quad = quads_.quads[q];
      if (std::any_of(quad.begin(), quad.end(), [&](int v) { return changed[v] != 0; })) {
        kept_.jacobian[q] = scaled_jacobian(column(q), kept_.levels);
      }
    });
  }

  void shrink_bad_columns() {
    std::vector<char> bad(quads_.quads.size());
    for (;;) {
      find_jacobians();
      parallel_for(bad.size(), [&](std::size_t q) {
        bad[q] = kept_.jacobian[q] < bound_[q] || is_narrowed_or_widened(q) ? 1 : 0;
      });
      std::vector<int> marked;
      for (std::size_t q = 0; q < bad.size(); ++q) {
        if (bad[q] != 0) marked.push_back(static_cast<int>(q));
      }
      if (marked.empty()) marked = skewed_columns();
      if (marked.empty()) return;
      shrink(marked, "fits");
    }
  }

  // Skewed columns that a thinner wall may still mend.
  std::vector<int> skewed_columns() {
    std::vector<int> skewed = kept_.skewness.quads_above(greatest_skewness, kept_.columns);
    skewed.erase(std::remove_if(skewed.begin(), skewed.end(),
                                [&](int q) {
                                  const auto& quad = quads_.quads[q];
                                  return std::all_of(quad.begin(), quad.end(), [&](int v) {
                                    return given()[v] < least_ratio_for_skewness * result_.asked[v];
                                  });
                                }),
                 skewed.end());
    return skewed;
  }

  // Thins the wall until its skin nowhere meets itself: in the places found first, then over all.
  void separate() {
    const double room = kept_.for_core ? clearance_for_core : clearance;
    const auto columns = [&] { return column_edges(quads_, directions_, trial_); };
    std::vector<int> colliding = kept_.skin.collisions(columns(), room);
    result_.colliding_quads = static_cast<int>(colliding.size());
    while (!colliding.empty()) {
      const std::vector<int> among = with_neighbours(colliding);
      for (; !colliding.empty(); colliding = kept_.skin.collisions(columns(), room, among)) {
        shrink(colliding, "keeps clear of the wall beside it");
      }
      shrink_bad_columns();
      colliding = kept_.skin.collisions(columns(), room);
    }
  }

  std::vector<int> with_neighbours(const std::vector<int>& quads) const {
    std::vector<char> near(quads_.points.size(), 0);
    for (const int q : quads) {
      for (const int v : quads_.quads[q]) near[v] = 1;
    }
    std::vector<int> result;
    for (std::size_t q = 0; q < quads_.quads.size(); ++q) {
      const auto& quad = quads_.quads[q];
      if (std::any_of(quad.begin(), quad.end(), [&](int v) { return near[v] != 0; })) {
        result.push_back(static_cast<int>(q));
      }
    }
    return result;
  }

  void shrink(const std::vector<int>& quads, const std::string& aim) {
    std::vector<char> marked(quads_.points.size(), 0);
    for (const int q : quads) {
      for (const int v : quads_.quads[q]) marked[v] = 1;
    }
    for (std::size_t v = 0; v < marked.size(); ++v) {
      if (marked[v] == 0) continue;
      given()[v] *= shrink_factor;
      if (given()[v] >= least_ratio * result_.asked[v]) continue;
      throw MeshingError(
          fmt::format("no wall of positive thickness {} at {}. Smooth or remesh the surface there, "
                      "or choose a smaller --size",
                      aim, place_of(static_cast<int>(v))));
    }
    limit_slope();
  }

  void limit_slope() {
    std::vector<double>& t = given();
    for (bool changed = true; changed;) {
      changed = false;
      throw_if_cancelled();
      for (std::size_t e = 0; e < kept_.edges.size(); ++e) {
        const auto [a, b] = kept_.edges[e];
        const double most = std::min(t[a], t[b]) + room_[e];
        double& greater = t[a] > t[b] ? t[a] : t[b];
        if (greater <= most * (1.0 + slope_tolerance)) continue;
        greater = most;
        changed = true;
      }
    }
  }

  void judge() {
    result_.worst_vertex = 0;
    for (int v = 1; v < static_cast<int>(result_.given.size()); ++v) {
      if (result_.ratio(v) < result_.ratio(result_.worst_vertex)) result_.worst_vertex = v;
    }
    double area = 0.0;
    double reduced = 0.0;
    for (int q = 0; q < static_cast<int>(quads_.quads.size()); ++q) {
      const double quad_area = 0.5 * doubled_area_vector(corners_of(quads_, q)).norm();
      area += quad_area;
      for (const int v : quads_.quads[q]) {
        if (result_.ratio(v) < reduced_below) reduced += 0.25 * quad_area;
      }
    }
    result_.reduced_area_fraction = reduced / area;
  }

  const QuadMesh& quads_;
  const std::vector<Vec3>& directions_;
  Kept& kept_;
  WallShape trial_;
  std::vector<double> room_;   // #E greatest difference of thickness between the ends
  std::vector<double> bound_;  // #Q scaled Jacobian wanted
  ThicknessResult result_;
};

}  // namespace

ThicknessFitter::ThicknessFitter(const QuadMesh& quads, const LayerPlan& plan, Side side,
                                 bool for_core) {
  const std::vector<double> levels =
      side == Side::outward ? plan.outer_levels() : plan.inner_levels();
  kept_ = std::make_unique<Kept>(Kept{side,
                                      for_core && side == Side::inward,
                                      levels,
                                      edges_of(quads),
                                      Skin(quads, side),
                                      Skewness(quads, levels),
                                      {},
                                      {}});
}

ThicknessFitter::~ThicknessFitter() = default;
ThicknessFitter::ThicknessFitter(ThicknessFitter&&) noexcept = default;
ThicknessFitter& ThicknessFitter::operator=(ThicknessFitter&&) noexcept = default;

ThicknessResult ThicknessFitter::fit(const QuadMesh& quads, const std::vector<Vec3>& directions,
                                     const WallShape& shape, const std::vector<double>& shares) {
  return Fitter(quads, directions, shape, *kept_).run(shares);
}

ThicknessResult fit_thickness(const QuadMesh& quads, const std::vector<Vec3>& directions,
                              const WallShape& shape, Side side, bool for_core) {
  return ThicknessFitter(quads, shape.plan, side, for_core).fit(quads, directions, shape);
}

}  // namespace hexwall
