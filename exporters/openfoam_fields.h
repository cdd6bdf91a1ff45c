#pragma once

#include <vector>

#include "exporters/output_file.h"
#include "flow/flow_setup.h"
#include "hex/cell_mesh.h"

namespace hexwall {

/// The files 0/U and 0/p of a flow and, if it is a pulse, constant/boundaryData of its inlet.
/// \throw Error(internal) if a patch of `mesh` is neither a wall nor an opening of `setup`.
std::vector<OutputFile> openfoam_fields(const CellMesh& mesh, const FlowSetup& setup);

}  // namespace hexwall
