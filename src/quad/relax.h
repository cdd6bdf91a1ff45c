#pragma once

#include <vector>

#include "quad/quad_mesh.h"
#include "surface/connectivity.h"
#include "surface/triangle_surface.h"

namespace hexwall {

struct RelaxResult {
  int iterations = 0;
  int frozen_moves = 0;  ///< vertex moves refused because a quad would have become worse than the
                         ///< worst one, inverted or turned over, or an edge far too short
};

/// Target size of a quad: along its sides 0-1, 2-3 and along its sides 1-2, 3-0.
struct QuadSize {
  double along_x;
  double along_y;
};

/// Moves the vertices of a quad mesh on the input surface towards rectangles of given sizes.
///
/// Each iteration fits a rectangle to every quad, pulled towards its target size, and moves each
/// vertex to the mean of its corners (shape-up, after Bouaziz et al., "Shape-Up", SGP 2012, with
/// Jacobi steps), then back on the surface; vertices of a boundary loop slide along their loop. A
/// step never lowers the minimum scaled Jacobian of the mesh, inverts or turns over no quad that
/// was right, and shortens no edge below 5 % of the target size.
/// \param face #V triangle of `surface` on which each vertex lies; updated.
/// \param size #Q target of each quad.
RelaxResult relax(QuadMesh& mesh, std::vector<int>& face, const std::vector<QuadSize>& size,
                  const TriangleSurface& surface, const Connectivity& connectivity,
                  int iterations = 60);

}  // namespace hexwall
