#pragma once

#include <vector>

#include "hex/cell_mesh.h"

namespace hexwall {

/// A mesh of hexahedra alone, extruded from quads. Order of corners: the bottom quad, then the top
/// quad above it.
struct HexMesh : CellMesh {
  std::vector<int> layer;  ///< #C layer, 0 innermost
  std::vector<int> quad;   ///< #C index of the quad it was extruded from
};

}  // namespace hexwall
