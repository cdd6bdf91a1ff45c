#pragma once

#include <vector>

#include "hex/column.h"
#include "quad/quad_mesh.h"
#include "surface/loop_plane.h"

namespace hexwall {

/// Turns the directions at vertices of planar loops into the plane of their loop, so that the end
/// rings of the wall are flat. Where that would take more than 45 degrees, the surface nearly lying
/// in the plane, they are turned less and the ring stays more nearly perpendicular to the surface.
/// \param planes one per boundary loop. \param directions of the surface's normals.
void flatten_at_loops(const QuadMesh& quads, const std::vector<LoopPlane>& planes,
                      std::vector<Vec3>& directions);

/// Smooths the directions of extrusion where, and only where, columns of hexes would come out bad:
/// on creases, on noise, and where the surface curves more than the wall is thick. Each round
/// replaces the directions around bad columns by the mean of their neighbours', so that the
/// smoothed patches grow as long as needed. Directions at planar loops keep their angle
/// to the plane.
/// \param shape the wall as asked for. \returns the number of vertices whose direction changed.
int smooth_directions(const QuadMesh& quads, const std::vector<LoopPlane>& planes,
                      const WallShape& shape, std::vector<Vec3>& directions);

}  // namespace hexwall
