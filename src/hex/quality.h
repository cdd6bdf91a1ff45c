#pragma once

#include <array>
#include <vector>

#include "hex/hex_mesh.h"

namespace hexwall {

/// Scaled Jacobian of a hexahedron: the least over its 8 corners of the triple product of the unit
/// edge vectors there. 1 for a box, <= 0 when a corner is flat or inverted.
double scaled_jacobian(const std::array<Vec3, 8>& corners);

/// Corner positions of a hex.
std::array<Vec3, 8> corners_of(const HexMesh& mesh, int hex);

/// Scaled Jacobian of every hex. #H.
std::vector<double> scaled_jacobians(const HexMesh& mesh);

/// Volume of a hex, exact for trilinear faces split into four triangles around their centre.
double volume(const std::array<Vec3, 8>& corners);

}  // namespace hexwall
