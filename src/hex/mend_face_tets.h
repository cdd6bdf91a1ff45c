#pragma once

#include <vector>

#include "hex/column.h"
#include "quad/quad_mesh.h"
#include "surface/projector.h"

namespace hexwall {

/// Moves and turns vertices of the columns that lack face tets until there is a margin of 0.02,
/// without lowering a scaled Jacobian that is below 0.2, or to below that. For the few that
/// `even_out`, which knows the centres of cells approximately only, has left. \return vertices
/// moved or turned.
int mend_face_tets(QuadMesh& quads, std::vector<SurfacePoint>& places,
                   std::vector<Vec3>& directions, const SurfaceProjector& projector,
                   const WallShape& shape);

}  // namespace hexwall
