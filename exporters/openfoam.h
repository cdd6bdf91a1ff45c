#pragma once

#include <filesystem>

#include "hex/cell_mesh.h"

namespace hexwall {

/// Writes an OpenFOAM case whose mesh is `mesh`: constant/polyMesh/{points, faces, owner,
/// neighbour, boundary, cellZones} and the least system/ with which `checkMesh` runs in place.
/// Patches keep the order of `mesh.patches`, cells and points keep their numbers, internal faces
/// are in upper-triangular order. Same input, same bytes. Cost O(#C).
/// Limit: `checkMesh -allGeometry` calls the cells of a mesh with a single layer under-determined.
/// \param case_dir made if missing; files of an older case in it are replaced
/// \param metres_per_unit length of the mesh's unit in metres; OpenFOAM reads metres
/// \pre metres_per_unit > 0
/// \throw WriteError if a file cannot be written; a failed run leaves no polyMesh behind.
/// \throw Error(ExitCode::internal) if the mesh is inconsistent: a face with three cells, a
/// boundary face in no patch, a face in a patch that is no boundary face, a cell in no zone, a
/// patch or zone name that is not an OpenFOAM word. Nothing is written then.
void write_openfoam(const std::filesystem::path& case_dir, const CellMesh& mesh,
                    double metres_per_unit);

/// Writes a case of two regions for conjugate solvers: constant/REGION/polyMesh for each region of
/// `mesh`, and constant/regionProperties. What lies between them is a pair of patches of type
/// `mappedWall`, `lumen_to_wall` and `wall_to_lumen`, whose faces coincide. Otherwise as above.
/// \throw Error(ExitCode::internal) also if there are not two regions.
void write_openfoam_regions(const std::filesystem::path& case_dir, const CellMesh& mesh,
                            double metres_per_unit);

}  // namespace hexwall
