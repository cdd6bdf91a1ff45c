#pragma once

#include <span>
#include <vector>

#include "hex/column.h"
#include "quad/quad_mesh.h"

namespace hexwall {

/// What a column of hexes is like; see `hex/column.h`.
struct ColumnQuality {
  double scaled_jacobian = 0.0;
  double face_split = 0.0;
  double face_tet_margin = 0.0;
};

/// The quality of all columns of a wall that changes in few places from one look to the next: what
/// has not changed since the last one is not computed again.
class ColumnQualities {
 public:
  /// Of the columns as they are now, valid until the next call. \pre quads are connected, and
  /// layers planned, as they were at the first call.
  std::span<const ColumnQuality> of(const QuadMesh& quads, const std::vector<Vec3>& directions,
                                    const WallShape& shape);

 private:
  std::vector<ColumnEdge> edges_;  // #V at the last call
  std::vector<ColumnQuality> qualities_;
};

double least_scaled_jacobian(std::span<const ColumnQuality> columns);

/// #Q Columns whose faces between layers are not asked to be split: those that are warped far too
/// much for their layers, and all if many are, as in a wall too thin for the size of its quads.
std::vector<char> hopeless_columns(std::span<const ColumnQuality> columns);

}  // namespace hexwall
