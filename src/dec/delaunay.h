#pragma once

#include <vector>

#include "surface/connectivity.h"
#include "surface/triangle_surface.h"

namespace hexwall {

/// The same surface, point for point, with triangles whose cotangent weights are not negative.
struct DelaunaySurface {
  TriangleSurface surface;       ///< the input's vertices come first, with their numbers kept
  std::vector<int> parent_face;  ///< #F triangle of the input in which each triangle lies
  int splits = 0;                ///< edges split, each adding one vertex on an input edge
  int flips = 0;                 ///< edges flipped, always inside one triangle of the input
  int negative_edges = 0;        ///< edges left non-Delaunay (only if the split budget ran out)
};

/// Refines a surface until every interior edge is Delaunay, without changing its shape.
///
/// An edge of the input that is not Delaunay is split where the edge of the intrinsic flip would
/// cross it (both halves are Delaunay then); edges inside one input triangle are flipped. This
/// gives the maximum principle of the intrinsic Delaunay Laplacian on an ordinary mesh embedded in
/// the surface, on which level curves can be traced as they are. After Liu, Xu, Fan and He,
/// "Efficient construction and simplification of Delaunay meshes", ACM TOG 34(6), 2015.
/// Interior edges that join two vertices of the same boundary loop are split as well: a function
/// constant on the loop would be constant on triangles there.
///
/// \pre no triangle of `surface` is degenerate. \param mesh of `surface`.
DelaunaySurface make_delaunay(const TriangleSurface& surface, const Connectivity& mesh);

}  // namespace hexwall
