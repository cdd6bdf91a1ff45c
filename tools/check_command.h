#pragma once

#include "command.h"

namespace hexwall {

/// `hexwall check`: what is wrong with a surface, and what becomes of it. Its exit code is that
/// with which `hexwall mesh` would refuse the surface.
Command add_check(CLI::App& app);

}  // namespace hexwall
