#pragma once

#include <vector>

#include "hex/cell_mesh.h"
#include "lumen/lumen_opening.h"

namespace hexwall {

/// A straight tube along z, filled with hexes: a square grid in the middle of the cross-section,
/// rings around it.
struct CellTube {
  int across = 4;  ///< hexes on a side of the square; four times as many around
  int rings = 3;
  int along = 6;
  double radius_x = 1.0;  ///< half axes of the ellipse, or the radius of the circle
  double radius_y = 1.0;
  double length = 4.0;
  bool triangles = false;  ///< in `cross_section`: cut the square's quads into triangles
};

/// The hexes of `tube`. Patches: wall, inlet (z = 0), outlet; zone and region lumen.
CellMesh cell_tube(const CellTube& tube);

/// The openings of `cell_tube(tube)`, with the areas of its polygons.
std::vector<LumenOpening> openings(const CellTube& tube);

/// Points and faces of the inlet alone, faces counter-clockwise seen from outside (from z < 0).
struct CellDisc {
  std::vector<Vec3> points;
  std::vector<CellFace> faces;
};
CellDisc cross_section(const CellTube& tube);

}  // namespace hexwall
