#pragma once

#include <array>
#include <vector>

#include "surface/triangle_surface.h"

namespace hexwall {

/// Tetrahedra inside a closed surface.
struct TetMesh {
  std::vector<Vec3> points;              ///< those of the surface first, in their order
  std::vector<std::array<int, 4>> tets;  ///< of positive volume in VTK's order
  double seconds = 0.0;                  ///< that TetGen took
  long memory_bytes = 0;                 ///< greatest memory of the process that ran TetGen
};

struct TetOptions {
  double radius_edge_ratio = 1.414;  ///< TetGen's -q
  double min_dihedral = 14.0;        ///< degrees that TetGen's -q tries to keep
  double growth = 0.0;     ///< edges may grow by this share of the distance from the surface
  double seconds = 600.0;  ///< TetGen is ended after this time
};

/// Fills a closed surface with tetrahedra by TetGen, without points on the surface (switches
/// -pYq…a). Edges are about as long as wanted at the nearest vertex, and longer by `growth` times
/// the distance from it.
/// TetGen runs in a process of its own, since bad input makes it abort or crash.
/// \param surface closed, oriented, counter-clockwise seen from outside.
/// \param edge #V wanted edge lengths, positive.
/// \throws GeometryError, naming the place, if the surface meets itself; MeshingError, naming the
/// narrowest place, if TetGen fails or takes too long.
TetMesh fill_with_tets(const TriangleSurface& surface, const std::vector<double>& edge,
                       const TetOptions& options);

}  // namespace hexwall
