#pragma once

#include <vector>

#include "hex/column.h"
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
/// search. First columns that fall short of what is needed, alone; then columns that are still poor
/// together with the rings of quads around them, as eight quads that meet at a zero need room.
/// Vertices of boundary loops stay where they are.
/// \param places #V triangle and position of each vertex of `quads`; updated with `quads.points`.
/// \param directions #V unit vectors; updated. \param shape the wall as asked for.
PolishResult polish(QuadMesh& quads, std::vector<SurfacePoint>& places,
                    std::vector<Vec3>& directions, const SurfaceProjector& projector,
                    const WallShape& shape);

/// Polishes further, for columns whose faces OpenFOAM cannot split (`has_face_tets`), at the cost
/// of their scaled Jacobians. \param shape the wall as it is. \param share from 0 to 1 of how far
/// to go.
void favour_face_tets(QuadMesh& quads, std::vector<SurfacePoint>& places,
                      std::vector<Vec3>& directions, const SurfaceProjector& projector,
                      const WallShape& shape, double share);

}  // namespace hexwall
