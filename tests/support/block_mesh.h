#pragma once

#include "hex/hex_mesh.h"

namespace hexwall {

/// A straight tube along z of hexes in a structured grid.
struct BlockTube {
  int around = 12;  ///< hexes around, at least 3
  int along = 4;
  int layers = 2;
  double inner_radius = 1;
  double outer_radius = 1.5;
  double length = 3;
  int inner_layers = 0;  ///< as many layers are the region lumen, inside the face zone interface
};

/// The hexes of `tube`, layer by layer from the lumen. Patches: inner_wall, outer_wall (walls),
/// loop_0 (z = 0), loop_1; one zone layer_k per layer; region wall; `quad` numbers the quads of a
/// layer.
HexMesh block_mesh(const BlockTube& tube);

/// Volume of the hexes of `block_mesh(tube)`, exactly: prisms over regular polygons.
double volume(const BlockTube& tube);

}  // namespace hexwall
