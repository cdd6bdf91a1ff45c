#pragma once

#include <vector>

#include "hex/cell_mesh.h"

namespace hexwall {

struct ImproveResult {
  int rounds = 0;
  int moved = 0;        ///< vertices that lie elsewhere now
  int reconnected = 0;  ///< replacements of tetrahedra, see `reconnect`
};

/// Moves vertices to improve the worst faces: non-orthogonality, skewness, weights and volume
/// ratios as OpenFOAM defines them. Cells stay valid: of positive volume towards each face.
/// \param movable #V vertices that may move.
ImproveResult improve(CellMesh& mesh, const std::vector<char>& movable);

}  // namespace hexwall
