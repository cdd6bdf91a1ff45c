#pragma once

#include <vector>

#include "hex/column.h"
#include "quad/quad_mesh.h"
#include "surface/loop_plane.h"

namespace hexwall {

/// Turns the directions at vertices of planar loops into the plane of their loop, so that the end
/// rings of the wall are flat. \param planes one per boundary loop.
void flatten_at_loops(const QuadMesh& quads, const std::vector<LoopPlane>& planes,
                      std::vector<Vec3>& directions);

/// Smooths the directions of extrusion where, and only where, columns of hexes would come out bad:
/// on creases, on noise, and where the surface curves more than the wall is thick. Each round
/// replaces the directions around bad columns by the mean of their neighbours', so that the
/// smoothed patches grow as long as needed. Directions at planar loops stay in their planes.
/// \param shape the wall as asked for. \returns the number of vertices whose direction changed.
int smooth_directions(const QuadMesh& quads, const std::vector<LoopPlane>& planes,
                      const WallShape& shape, std::vector<Vec3>& directions);

}  // namespace hexwall
