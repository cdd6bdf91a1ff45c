#pragma once

#include "command.h"

namespace hexwall {

/// `hexwall reference`, which --help does not show: what the program says of itself, for the
/// documentation, manual pages and completion that are made from it. To be added last.
Command add_reference(CLI::App& app);

}  // namespace hexwall
