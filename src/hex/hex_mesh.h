#pragma once

#include <array>
#include <string>
#include <vector>

#include "surface/triangle_surface.h"

namespace hexwall {

/// A boundary face: vertices counter-clockwise seen from outside the mesh, and the hex behind it.
struct BoundaryFace {
  std::array<int, 4> vertices;
  int hex;
};

/// A named part of the boundary.
struct BoundaryPatch {
  std::string name;
  bool is_wall = false;  ///< OpenFOAM type `wall` rather than `patch`
  std::vector<BoundaryFace> faces;
};

/// A named set of hexes.
struct CellZone {
  std::string name;
  std::vector<int> hexes;
};

/// A named set of faces between hexes: vertices counter-clockwise seen from the side that the zone
/// faces, and the hex on the other side.
struct FaceZone {
  std::string name;
  std::vector<BoundaryFace> faces;
};

/// A hexahedral mesh. Vertex order of VTK_HEXAHEDRON: the bottom quad, then the top quad above it.
struct HexMesh {
  std::vector<Vec3> points;
  std::vector<std::array<int, 8>> hexes;
  std::vector<int> layer;                 ///< #H layer, 0 innermost
  std::vector<int> quad;                  ///< #H index of the quad it was extruded from
  std::vector<BoundaryPatch> patches;     ///< partition of all boundary faces
  std::vector<CellZone> zones;            ///< partition of all hexes
  std::vector<CellZone> regions = {};     ///< coarser partition: lumen and wall, as far as there
  std::vector<FaceZone> face_zones = {};  ///< interface between the regions, if there are two
};

}  // namespace hexwall
