#pragma once

#include <CLI/CLI.hpp>

#include "command.h"

namespace hexwall {

/// `hexwall view`: opens the report of a run in the browser, or says where it is.
Command add_view(CLI::App& app);

}  // namespace hexwall
