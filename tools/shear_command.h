#pragma once

#include "command.h"

namespace hexwall {

/// `hexwall shear`: wall shear stress of an OpenFOAM case after its run, in words, JSON and VTP.
Command add_shear(CLI::App& app);

}  // namespace hexwall
