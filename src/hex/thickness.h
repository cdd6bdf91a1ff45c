#pragma once

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

/// The largest thickness up to `shape`'s with which the columns of one side come out well.
///
/// It is reduced where a hex would have a corner of scaled Jacobian below 0.2, or below half of
/// what it has in the limit of no thickness if that is less; and where the skin would meet itself,
/// the surface or an end ring, with a clearance of 5 % of the thickness; and, down to a fifth,
/// where a face would be more skewed than OpenFOAM's checkMesh allows. Reductions spread smoothly:
/// thickness changes along the surface by a slope of 0.3 at most, more only where that much was
/// asked. No layer is ever dropped. \param directions #V unit vectors, outward.
/// \param for_core whether the lumen behind layers inside is to be filled: the clearance is then
/// 25 %, and edges towards the core have 0.35 to 3 times the length of the wall's.
/// \param shares #V no more than these shares of `shape`'s, of an earlier fit for instance; 1 if it
/// is empty.
/// \pre `shape` has layers on that side.
/// \throws MeshingError, naming the place, if more is asked than half of the surface's diagonal, or
/// layers so thin that they are lost in the rounding of coordinates; if no positive thickness gives
/// positive Jacobians, or none keeps the skin from meeting itself.
ThicknessResult fit_thickness(const QuadMesh& quads, const std::vector<Vec3>& directions,
                              const WallShape& shape, Side side, bool for_core = false,
                              const std::vector<double>& shares = {});

}  // namespace hexwall
