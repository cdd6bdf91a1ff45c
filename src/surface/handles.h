#pragma once

#include <vector>

#include "surface/connectivity.h"
#include "surface/triangle_surface.h"

namespace hexwall {

/// Vertices of a short closed line of edges around or along a handle: a line that does not divide
/// the surface, even where its boundary loops are closed. Empty if the surface has no handle.
///
/// Of a shortest-path tree and a spanning tree of the dual graph that does not cross it, 2 genus
/// edges are left over, and each closes such a line (D. Eppstein, Dynamic generators of
/// topologically embedded graphs, SODA 2003). The dual tree takes the longest lines first, which
/// leaves the shortest through the root (J. Erickson, K. Whittlesey, Greedy optimal homotopy and
/// homology generators, SODA 2005); the root moves a few times to the best line so far.
/// \pre one connected component. Cost: O(#E log #E).
std::vector<int> handle_line(const TriangleSurface& surface, const Connectivity& mesh);

}  // namespace hexwall
