#pragma once

#include <span>
#include <vector>

#include "hex/column_quality.h"
#include "quad/quad_mesh.h"
#include "surface/projector.h"

namespace hexwall {

struct PolishResult {
  int columns_before = 0;  ///< columns of hexes short of the goals before and after
  int columns_after = 0;
  int moved = 0;  ///< vertices moved or turned
};

/// Improves the few columns of hexes that would come out bad, near zeros on strongly curved
/// crotches mostly: moves their vertices on the surface and tilts their directions, by pattern
/// search on the sum of the squared shortfalls of scaled Jacobians and of how faces between layers
/// can be split. All other vertices stay. Vertices of boundary loops stay where they are.
/// \param places #V triangle and position of each vertex of `quads`; updated with `quads.points`.
/// \param directions #V unit vectors; updated. \param shape the wall as asked for.
/// \param columns #Q of it.
PolishResult polish(QuadMesh& quads, std::vector<SurfacePoint>& places,
                    std::vector<Vec3>& directions, const SurfaceProjector& projector,
                    const WallShape& shape, std::span<const ColumnQuality> columns);

}  // namespace hexwall
