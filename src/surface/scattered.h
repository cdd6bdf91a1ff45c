#pragma once

#include <vector>

#include "surface/read_points.h"
#include "surface/triangle_surface.h"

namespace hexwall {

/// Scattered values interpolated at other places: the mean of the 8 nearest ones, weighted by the
/// squared inverse of their distances (Shepard's method). A place with a value gets exactly that.
/// Nearest is meant in space: values on a branch close by count as well. \pre `values` is not
/// empty.
std::vector<double> interpolate_scattered(const std::vector<PointValue>& values,
                                          const std::vector<Vec3>& places);

}  // namespace hexwall
