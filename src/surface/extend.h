#pragma once

#include <string>
#include <vector>

#include "surface/triangle_surface.h"

namespace hexwall {

struct ExtendResult {
  TriangleSurface surface;         ///< the vessel first, unchanged, then the extensions
  std::vector<int> extension;      ///< #F: -1 on the vessel, else the number of the opening
  std::vector<int> end_vertex;     ///< one per opening: a vertex of its new boundary loop
  std::vector<std::string> notes;  ///< one sentence per opening
};

/// Adds a tube to each opening, `radii` times its mean radius long, along the loop's outward
/// normal, so that a flow can develop before it reaches the vessel. Openings are numbered as the
/// loops of `Connectivity`.
///
/// The tube begins with the loop's own vertices, planar or not. Over the first half of its length,
/// but no more than two radii, its section turns linearly with a smooth step into a regular polygon
/// of the loop's area (the flow keeps its mean velocity), and its axis turns from the vessel's
/// own direction at the end into the normal, so that the tube leaves an oblique end without a fold.
/// The mean radius is that of the polygon. The tube's end is planar, `radii` radii beyond the
/// farthest vertex of the loop. Triangles have the loop's mean edge length.
/// \pre as after `check_surface`.
/// \throws UsageError unless `radii` is positive, GeometryError, naming the opening, if a tube
/// meets the vessel, another tube or itself.
ExtendResult extend_openings(const TriangleSurface& surface, double radii);

}  // namespace hexwall
