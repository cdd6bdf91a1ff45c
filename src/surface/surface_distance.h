#pragma once

#include "surface/triangle_surface.h"

namespace hexwall {

/// Greatest distance between two surfaces, both ways: from the corners and centroids of each one's
/// triangles to the other one. Triangles that both have, with the same coordinates, are left out,
/// so that a local change costs little. Zero for equal surfaces. \pre finite coordinates, both have
/// triangles with area.
double surface_distance(const TriangleSurface& a, const TriangleSurface& b);

}  // namespace hexwall
