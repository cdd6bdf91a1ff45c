#pragma once

#include <vector>

#include "foliation/foliation.h"
#include "quad/quad_mesh.h"
#include "quad/quantise.h"

namespace hexwall {

/// The quad mesh of a quantised foliation, with its vertices on the surface.
struct ExtractResult {
  QuadMesh mesh;
  std::vector<double> column_width;              ///< #Q mean width in x of the quads of its ring
  std::vector<double> row_height;                ///< #Q height of each quad in y
  std::vector<int> face;                         ///< #V triangle on which each vertex lies
  std::vector<std::vector<int>> vertical_lines;  ///< vertices along critical trajectories, one
                                                 ///< list per trajectory and cylinder
  int corrected_levels = 0;                      ///< level curves on which x was made monotone
};

/// Intersects the grid lines x = const, y = const of each cylinder: every level curve is traced
/// exactly on the piecewise linear y, and its points are found by x along it. Vertices on critical
/// curves belong to arcs, so neighbouring cylinders share them by construction.
ExtractResult extract_quads(const TriangleSurface& surface, const Connectivity& mesh,
                            const HolomorphicForm& form, const Foliation& foliation,
                            const std::vector<RowSpacing>& spacing,
                            const Quantisation& quantisation);

}  // namespace hexwall
