#pragma once

#include <vector>

#include "hex/column.h"
#include "quad/quality.h"

namespace hexwall {

/// Skewness of the faces of the hexes that columns consist of, as OpenFOAM's checkMesh measures it:
/// how far the line between the centres of the cells on both sides (or, at the boundary, the normal
/// through the cell's centre) passes from the face's centre, relative to the face's extent in that
/// direction. 0 is best; checkMesh reports faces above 4.
class Skewness {
 public:
  explicit Skewness(const QuadMesh& quads);

  /// Quads whose column has a face above `limit`. Sorted. \param levels of one side, see
  /// `LayerPlan`.
  std::vector<int> quads_above(double limit, const std::vector<Vec3>& directions,
                               const WallShape& shape, const std::vector<double>& levels) const;

 private:
  const QuadMesh& quads_;
  std::vector<QuadEdge> edges_;
};

}  // namespace hexwall
