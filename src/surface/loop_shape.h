#pragma once

#include <vector>

#include "surface/triangle_surface.h"

namespace hexwall {

/// Size and place of a closed polyline, planar or nearly so.
struct LoopShape {
  Vec3 center;    ///< centroid of the enclosed area
  Vec3 normal;    ///< unit; the polyline runs counter-clockwise around it
  double area;    ///< length of the area vector
  double length;  ///< of the polyline
  double radius;  ///< of the circle of equal area
};

/// The area vector is that of a fan, ½ Σ p_i x p_i+1, the same for every choice of its centre.
/// A loop without area (all points on a line) has the normal 0 and its mean point as centre.
/// \pre at least 3 points.
LoopShape loop_shape(const std::vector<Vec3>& loop);

/// The positions of a loop's vertices.
std::vector<Vec3> points_of(const TriangleSurface& surface, const std::vector<int>& loop);

}  // namespace hexwall
