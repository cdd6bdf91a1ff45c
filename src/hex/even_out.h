#pragma once

#include <span>
#include <vector>

#include "hex/column_quality.h"
#include "quad/quad_mesh.h"
#include "surface/projector.h"

namespace hexwall {

struct EvenOutOptions {
  std::span<const ColumnQuality> columns;  ///< #Q of the wall as it is
  std::span<const double> least_edge;      ///< #V lengths that no edge there falls short of
  double face_tets = 0.0;  ///< from 0 to 1, or above: weight of faces that OpenFOAM can split
                           ///< (`has_face_tets`), at the cost of scaled Jacobians
};

/// Raises the worst hexes: columns that are poor still after `polish` are evened out together with
/// the rings of quads around them, as eight quads that meet at a zero need room. Minimises the sum
/// of the 16th power of what the corners of all hexes there lack, by pattern search.
/// \param places, directions as for `polish` \param shape the wall as it is.
/// \return vertices moved or turned.
int even_out(QuadMesh& quads, std::vector<SurfacePoint>& places, std::vector<Vec3>& directions,
             const SurfaceProjector& projector, const WallShape& shape,
             const EvenOutOptions& options);

/// Raises the very worst hexes further, of what `even_out` left: the same with powers up to the
/// 128th, which come close to the least scaled Jacobian itself. Faces that OpenFOAM can split stay
/// so, but in `hopeless_columns`; `face_tets` does not count. \return vertices moved or turned.
int even_out_worst(QuadMesh& quads, std::vector<SurfacePoint>& places,
                   std::vector<Vec3>& directions, const SurfaceProjector& projector,
                   const WallShape& shape, const EvenOutOptions& options);

}  // namespace hexwall
