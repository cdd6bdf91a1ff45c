#pragma once

#include <filesystem>

#include "hex/hex_mesh.h"

namespace hexwall {

/// Writes the `mesh-complete` folder of SimVascular and svMultiPhysics (svFSI, svFSIplus):
/// `mesh-complete.mesh.vtu` (the mesh), `mesh-surfaces/PATCH.vtp` per patch,
/// `mesh-complete.exterior.vtp` (all patches), `walls_combined.vtp` (the patches that are walls, if
/// any) and `domain_ids.dat` (the zone of each hex, a number per line: svMultiPhysics reads domains
/// as text). All numbers are 32-bit integers from 1: `GlobalNodeID`, `GlobalElementID` (on a
/// surface that of the hex behind the face), `ModelRegionID` (zone), `ModelFaceID` (patch). Hexes
/// have VTK's order of vertices, faces are quads that point out. Lengths are in the unit of `mesh`.
/// Same input, same bytes. Cost O(#H). Limit: svMultiPhysics keeps domains as bits of an integer,
/// so it takes 30 zones at most. \param folder made if missing; files of an older mesh in it are
/// replaced \throw WriteError if a file cannot be written; a failed run leaves none of the files
/// behind. \throw Error(ExitCode::internal) if the patches are no partition of the boundary faces,
/// the zones none of the hexes, or a patch's name cannot be the name of a file. Nothing is written
/// then.
void write_svmultiphysics(const std::filesystem::path& folder, const HexMesh& mesh);

}  // namespace hexwall
