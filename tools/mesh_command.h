#pragma once

#include "command.h"

namespace hexwall {

/// `hexwall mesh`: from a vessel surface to the hexahedra of its wall, with a report.
Command add_mesh(CLI::App& app);

}  // namespace hexwall
