#pragma once

#include <string>

#include "surface/triangle_surface.h"

namespace hexwall {

/// An opening of the lumen: a planar or nearly planar patch of the mesh.
struct LumenOpening {
  std::string patch;  ///< its name
  bool inlet = false;
  Vec3 center;  ///< centroid of its area
  Vec3 normal;  ///< unit, out of the lumen
  double area = 0.0;
  double radius = 0.0;  ///< of the circle of equal area
};

}  // namespace hexwall
