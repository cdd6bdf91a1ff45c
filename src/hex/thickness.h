#pragma once

#include <memory>
#include <vector>

#include "hex/column.h"

namespace hexwall {

/// Hexes better than this need no thinner wall.
constexpr double wanted_scaled_jacobian = 0.2;

/// One side of the surface.
enum class Side { outward, inward };

/// How thick the layers on one side are.
struct ThicknessResult {
  std::vector<double> asked;  ///< #V
  std::vector<double> given;  ///< #V, at most what was asked, nowhere 0
  int worst_vertex = -1;      ///< least given / asked

  /// Share of the surface's area with less than 99 % of what was asked.
  double reduced_area_fraction = 0.0;
  /// Quads whose columns would have met others at the thickness asked.
  int colliding_quads = 0;

  double ratio(int v) const { return given[v] / asked[v]; }
};

/// Fits the thickness of the layers on one side, several times while quads and directions change in
/// few places: what has not changed since the last fit is not judged again.
class ThicknessFitter {
 public:
  struct Kept;  ///< what stays from one fit to the next

  /// \param quads how they are connected; stays. \param plan of the layers; has some on that side.
  /// \param for_core whether the lumen behind layers inside is to be filled: the clearance is then
  /// 25 %, and edges towards the core have 0.35 to 3 times the length of the wall's.
  ThicknessFitter(const QuadMesh& quads, const LayerPlan& plan, Side side, bool for_core = false);
  ~ThicknessFitter();
  ThicknessFitter(ThicknessFitter&&) noexcept;
  ThicknessFitter& operator=(ThicknessFitter&&) noexcept;

  /// The largest thickness up to `shape`'s with which the columns of the side come out well.
  ///
  /// It is reduced where a hex would have a corner of scaled Jacobian below 0.2, or below half of
  /// what it has in the limit of no thickness if that is less; and where the skin would meet
  /// itself, the surface or an end ring, with a clearance of 5 % of the thickness; and, down to a
  /// fifth, where a face would be more skewed than OpenFOAM's checkMesh allows. Reductions spread
  /// smoothly: thickness changes along the surface by a slope of 0.3 at most, more only where that
  /// much was asked. No layer is ever dropped.
  ///
  /// \param directions #V unit vectors, outward.
  ///
  /// \param shares #V no more than these shares of `shape`'s, of an earlier fit for instance; 1 if
  /// it is empty.
  ///
  /// \throws MeshingError, naming the place, if more is asked than half of the surface's diagonal,
  /// or layers so thin that they are lost in the rounding of coordinates; if no positive thickness
  /// gives positive Jacobians, or none keeps the skin from meeting itself.
  ThicknessResult fit(const QuadMesh& quads, const std::vector<Vec3>& directions,
                      const WallShape& shape, const std::vector<double>& shares = {});

 private:
  std::unique_ptr<Kept> kept_;
};

/// A single fit.
ThicknessResult fit_thickness(const QuadMesh& quads, const std::vector<Vec3>& directions,
                              const WallShape& shape, Side side, bool for_core = false);

}  // namespace hexwall
