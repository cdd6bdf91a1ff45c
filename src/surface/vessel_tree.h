#pragma once

#include <vector>

#include "surface/triangle_surface.h"

namespace hexwall {

/// A vessel along a curve: an end that is not open has to lie inside another branch.
struct Branch {
  std::vector<Vec3> centerline;  ///< at least 2 points, interpolated by a Catmull–Rom spline
  std::vector<double> radii;     ///< one per point, interpolated likewise
  bool open_start = false;       ///< cut flat at the first point, across the centreline
  bool open_end = false;         ///< cut flat at the last point
  double blend = 0.0;            ///< width of the fillet where the branch leaves the former ones
};

/// Surface of the smooth union of branches, with triangles of about the edge length `edge`: one
/// boundary loop, exactly planar, for each open end. Vertices lie on the implicit surface.
///
/// Each branch is the envelope of balls along its centreline; each is joined to the former ones by
/// a polynomial smooth minimum, which acts only where both are nearer than `blend` to each other.
/// Meshed by marching cubes at half the smallest radius, cut, and remeshed isotropically.
/// \pre branches meet where they should and nowhere else; near an open end, within three radii of
/// it and beyond its plane, there is no other branch.
/// \throws UsageError if `edge` exceeds the smallest radius.
TriangleSurface vessel_tree(const std::vector<Branch>& branches, double edge);

}  // namespace hexwall
