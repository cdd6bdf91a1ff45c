#pragma once

#include <utility>
#include <vector>

#include "surface/triangle_surface.h"

namespace hexwall {

/// Pairs of triangles that meet anywhere but in their common vertices and edges, decided with exact
/// predicates unless a plane is clearly between them. Sorted, the lower number first.
/// \pre manifold, consistent winding, no triangle without area.
/// Cost: O((#F + #pairs) log #F).
std::vector<std::pair<int, int>> self_intersections(const TriangleSurface& surface);

/// The same among the given triangles only. \param triangles sorted, each once.
std::vector<std::pair<int, int>> self_intersections(const TriangleSurface& surface,
                                                    const std::vector<int>& triangles);

}  // namespace hexwall
