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

struct RowSpacingOptions {
  double size = 1.0;           ///< target edge length in space
  double size_in_plane = 1.0;  ///< the same in the (x, y) plane
  double evenness = 0.5;       ///< 0: rows of equal height in y, squares under the conformal map;
                          ///< 1: rows of height `size` in space, on the mean of each level curve
};

/// Spreads rows so that they stay even along vessels where the conformal scale varies. The
/// conformal map's stretch on a level curve is s, the root mean square of 1 / |grad y| in x; rows
/// are denser by (s * size_in_plane / size)^evenness than conformal ones. Grid lines stay what they
/// are: level curves and vertical trajectories, at right angles to each other.
std::vector<RowSpacing> space_rows(const TriangleSurface& surface, const Connectivity& mesh,
                                   const HolomorphicForm& form,
                                   const std::vector<double>& scale_factor,
                                   const std::vector<Cylinder>& cylinders,
                                   const RowSpacingOptions& options);

}  // namespace hexwall
