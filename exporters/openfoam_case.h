#pragma once

#include <filesystem>

#include "flow/flow_setup.h"
#include "hex/cell_mesh.h"

namespace hexwall {

/// How a case is written and run.
struct OpenFoamCase {
  double metres_per_unit = 1.0;  ///< of the mesh; positive
  int processes = 1;             ///< that `Allrun` runs the solver in
};

/// Writes a case of a flow that OpenFOAM 1912 runs as it is: the mesh (see `write_openfoam`), 0/,
/// constant/, system/, `Allrun`, `Allclean` and, for ParaView, `case.foam`. Steady flow is for
/// simpleFoam, pulsatile flow for pimpleFoam; laminar, Newtonian or Carreau (OpenFOAM's
/// BirdCarreau). All in SI units; OpenFOAM's p and wall shear stress are over the density.
/// exporters/README.md says what is in each file. Same input, same bytes.
/// \param setup of `mesh`. Every other patch than its openings must be a wall.
/// \throw WriteError if a file cannot be written, Error(internal) as `write_openfoam`, and if a
/// patch is neither wall nor opening.
void write_openfoam_case(const std::filesystem::path& case_dir, const CellMesh& mesh,
                         const FlowSetup& setup, const OpenFoamCase& options);

}  // namespace hexwall
