#pragma once

#include <vector>

#include "surface/triangle_surface.h"

namespace hexwall {

/// A plane fitted to a loop of points: unit normal, centroid, mean radius, and the greatest
/// distance of a point from it.
struct LoopPlane {
  Vec3 center;
  Vec3 normal;
  double radius = 0.0;
  double deviation = 0.0;
  bool is_planar() const;
};
LoopPlane fit_plane(const std::vector<Vec3>& loop);

}  // namespace hexwall
