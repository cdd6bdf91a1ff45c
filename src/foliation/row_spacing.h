#pragma once

#include <vector>

#include "foliation/cylinders.h"

namespace hexwall {

/// How rows of quads are spread over the height of a cylinder: the number of rows below each of a
/// series of levels, as a real number, piecewise linear in y.
struct RowSpacing {
  std::vector<double> y;     ///< rising, from the cylinder's bottom to its top
  std::vector<double> rows;  ///< rising, from 0 to the number of rows wanted

  double wanted() const { return rows.back(); }
  double rows_below(double y_value) const;
  double y_of(double row) const;  ///< inverse of `rows_below`
};

/// The scale of the conformal map on each triangle.
struct FaceScales {
  const std::vector<double>& factor;      ///< #F |grad y|
  const std::vector<double>& size_ratio;  ///< #F size of conformal quads over their target
};

struct RowSpacingOptions {
  double size_in_plane = 1.0;  ///< target edge length in the (x, y) plane
  double evenness = 0.5;       ///< 0: rows of equal height in y, squares under the conformal map;
                               ///< 1: rows of the target height in space, on the mean of each level
                               ///< curve
};

/// Spreads rows so that they stay near their target size along vessels where the conformal scale
/// varies. With r the root mean square in x, on a level curve, of the size of conformal quads over
/// their target, rows are denser by r^evenness than conformal ones. Grid lines stay what they are:
/// level curves and vertical trajectories, at right angles to each other.
std::vector<RowSpacing> space_rows(const TriangleSurface& surface, const Connectivity& mesh,
                                   const HolomorphicForm& form, const FaceScales& scales,
                                   const std::vector<Cylinder>& cylinders,
                                   const RowSpacingOptions& options);

}  // namespace hexwall
