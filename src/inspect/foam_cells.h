#pragma once

#include "inspect/any_mesh.h"

namespace hexwall {

/// Makes cells of faces: the elements of `mesh`, whose points are there already. A cell that is a
/// tetrahedron, pyramid, wedge or hexahedron by its faces gets its corners in VTK's order, any
/// other is a polyhedron.
/// \throws ReadError if a face has an owner, neighbour or vertex out of range, or a cell fewer than
/// four faces.
void add_cells(FaceMesh faces, AnyMesh& mesh);

}  // namespace hexwall
