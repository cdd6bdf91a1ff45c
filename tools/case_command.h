#pragma once

#include "command.h"

namespace hexwall {

/// `hexwall case`: from a vessel surface to an OpenFOAM case of the flow in it, ready to run.
Command add_case(CLI::App& app);

}  // namespace hexwall
