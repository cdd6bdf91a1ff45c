#pragma once

#include <filesystem>

#include "hex/cell_mesh.h"

namespace hexwall {

/// Writes a Gmsh mesh, MSH 4.1 in ASCII (about the size of binary, in which every tag takes 8
/// bytes, and readable by more programs). Physical volumes are the zones, physical surfaces the
/// patches, numbered from 1 in their order. The discrete entities are one volume per zone, and one
/// surface per patch and zone behind it, which bounds that volume; the faces between zones belong
/// to no entity. Node and cell tags are the mesh's numbers + 1, those of the faces follow.
/// Coordinates are written to the last bit in the unit of `mesh`. Same input, same bytes. Cost
/// O(#C). \throw WriteError if the file cannot be written; nothing half-written stays
/// behind. \throw Error(ExitCode::internal) if the patches are no partition of the boundary faces,
/// the zones none of the cells, or a name has a quote or a control character. Nothing is written
/// then.
void write_gmsh(const std::filesystem::path& path, const CellMesh& mesh);

}  // namespace hexwall
