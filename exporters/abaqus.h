#pragma once

#include <filesystem>
#include <string>

#include "hex/hex_mesh.h"

namespace hexwall {

struct AbaqusOptions {
  std::string element_type = "C3D8";  ///< any 8-node brick of Abaqus or CalculiX: C3D8I, C3D8R, …
};

/// Writes a mesh file for `*INCLUDE` in an input deck of Abaqus or CalculiX: *NODE, *ELEMENT with
/// an ELSET per zone, *NSET and *SURFACE (faces S1 … S6) per patch; no material, no step. Nodes and
/// elements are numbered from 1 in the mesh's order, lengths are in the unit of `mesh`.
///
/// Coordinates are written to the last bit where 20 characters suffice, which is all that CalculiX
/// reads of a number; longer ones, in scientific notation, keep at least 12 digits. Names become
/// labels that both programs accept: other characters than letters, digits and `_` become `_`,
/// `set_` is put before what does not start with a letter, labels end after 80 characters, and
/// labels that differ in case only get a number. Same input, same bytes. Cost O(#H).
/// \throw WriteError if the file cannot be written; nothing half-written stays behind.
/// \throw Error(ExitCode::internal) if the patches are no partition of the boundary faces or the
/// zones none of the hexes. Nothing is written then.
void write_abaqus(const std::filesystem::path& path, const HexMesh& mesh,
                  const AbaqusOptions& options = {});

}  // namespace hexwall
