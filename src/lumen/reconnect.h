#pragma once

#include <array>
#include <vector>

#include "hex/cell_mesh.h"

namespace hexwall {

/// Tetrahedra connected in another way where that improves the worst of them: edges are taken out
/// with all tetrahedra around them, and faces with the two beside them, and the hole is filled
/// anew. Points and all other cells stay. \param mesh where a cell is a tetrahedron from number
/// `first` on, the ones before are not.
/// \returns all tetrahedra, and sets `changes` to the number of replacements.
std::vector<std::array<int, 4>> reconnect(const CellMesh& mesh, int first, int& changes);

}  // namespace hexwall
