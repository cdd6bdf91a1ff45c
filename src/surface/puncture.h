#pragma once

#include <optional>
#include <vector>

#include "surface/connectivity.h"
#include "surface/projector.h"
#include "surface/triangle_surface.h"

namespace hexwall {

/// A round disk on a surface: what lies within `radius` of its centre, on the sheet of the centre.
struct SurfaceDisk {
  SurfacePoint center;
  double radius = 0.0;
};

/// A surface with round holes.
struct PuncturedSurface {
  TriangleSurface surface;                   ///< vertices of holes included, unused ones left out
  std::vector<int> parent_face;              ///< #F triangle of the original surface
  std::vector<int> hole_vertex;              ///< per hole: one vertex of its loop
  std::vector<std::vector<int>> disk_faces;  ///< per hole: triangles of the original surface in it
  std::vector<int> original_vertex;          ///< #V vertex of the original, -1 for new ones
};

/// Cuts disks out of a surface without changing its shape: triangles are refined around each disk,
/// then edges are split at the distance `radius` from its centre, so that the loops are round and
/// have some forty vertices, whatever the triangles of the input.
/// \param mesh of `surface`.
/// \returns nothing if a disk is not a topological disk clear of the boundary and of other disks:
/// try a smaller radius.
std::optional<PuncturedSurface> puncture(const TriangleSurface& surface, const Connectivity& mesh,
                                         const std::vector<SurfaceDisk>& disks);

}  // namespace hexwall
