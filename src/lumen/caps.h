#pragma once

#include <array>
#include <string>
#include <vector>

#include "surface/triangle_surface.h"

namespace hexwall {

/// A triangulated disc inside a closed polyline.
struct Cap {
  std::vector<Vec3> points;                   ///< inside; the rim gets none
  std::vector<std::array<int, 3>> triangles;  ///< vertices: those of the rim, then `points`
};

/// Fills a loop with triangles that are about as large as its edges: a constrained Delaunay
/// triangulation in the plane of the loop, refined and smoothed. Flat where the loop is flat, else
/// a harmonic surface over its plane.
/// \param rim counter-clockwise seen from where the triangles are to be.
/// \param name of the opening, for messages.
/// \throws MeshingError, naming the place, if the loop's projection onto its plane meets itself.
Cap fill_loop(const std::vector<Vec3>& rim, const std::string& name);

}  // namespace hexwall
