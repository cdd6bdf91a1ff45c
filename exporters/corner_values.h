#pragma once

#include <vector>

#include "exporters/vtk_files.h"

namespace hexwall {

/// Triangles with values at their corners, which may jump from triangle to triangle: corners at one
/// vertex become one point where all of their values agree, to 1e-9 of the greatest one.
/// \param of_corners arrays of doubles, 3 #F rows: corner by corner, triangle by triangle.
PolyData with_corner_values(const TriangleSurface& surface,
                            const std::vector<DataArray>& of_corners);

}  // namespace hexwall
