#pragma once

#include <vector>

#include "surface/cut_planes.h"
#include "surface/triangle_surface.h"

namespace hexwall {

struct ClipResult {
  TriangleSurface surface;
  std::vector<int> origin;  ///< #F: triangle of the input that it is, or is a piece of
  std::vector<int> loop;    ///< the new boundary: a vertex cycle, exactly in the plane
};

/// Cuts a surface along one closed section with a plane and removes what is connected to it on the
/// side of the plane's normal. Other branches that the plane crosses stay whole.
///
/// The section is the nearest to the plane's point among the closed ones around that point, or
/// the nearest of all if none is around it; given a radius, only sections within it count. Where
/// the plane passes close to a vertex, the vertex slides along an edge onto the plane, by less than
/// 1/6 of that edge, so that no slivers arise.
/// \throws GeometryError, naming the plane, if it misses the surface, the plane's point is farther
/// from the section than 3 of its radii and no radius is given, the section runs into a boundary or
/// an edge with more than two triangles, or cutting along it does not divide the surface.
ClipResult clip(const TriangleSurface& surface, const CutPlane& plane);

}  // namespace hexwall
