#pragma once

#include "command.h"

namespace hexwall {

/// `hexwall compare`: the hybrid mesh of a lumen beside meshes of tetrahedra of several sizes.
Command add_compare(CLI::App& app);

}  // namespace hexwall
