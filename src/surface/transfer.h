#pragma once

#include <vector>

#include "surface/surface_array.h"
#include "surface/triangle_surface.h"

namespace hexwall {

/// Values of a point array at the vertices of another surface near the first, such as the first
/// after a repair: interpolated linearly in the triangle at the nearest point of `from`. A vertex
/// whose coordinates equal those of a vertex of `from` gets exactly its value.
/// \returns #V(to) tuples, one after the other.
/// \pre `array` has #V(from) tuples; `from` has a triangle with area, no other triangle counts.
/// Cost: O(#V(to)) nearest points, each found in a grid of cells.
std::vector<double> transfer_point_array(const SurfaceArray& array, const TriangleSurface& from,
                                         const TriangleSurface& to);

}  // namespace hexwall
