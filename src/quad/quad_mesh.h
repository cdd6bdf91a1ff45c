#pragma once

#include <array>
#include <string>
#include <vector>

#include "surface/triangle_surface.h"

namespace hexwall {

/// A conforming all-quad surface mesh. Quads are counter-clockwise seen from outside.
struct QuadMesh {
  std::vector<Vec3> points;
  std::vector<std::array<int, 4>> quads;
  std::vector<int> cylinder;        ///< #Q cylinder of the foliation
  std::vector<int> patch;           ///< #Q rectangular patch: a strip in a cylinder
  std::vector<int> loop_of_vertex;  ///< #V boundary loop, -1 in the interior
};

}  // namespace hexwall
