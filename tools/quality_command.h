#pragma once

#include <CLI/CLI.hpp>

#include "command.h"

namespace hexwall {

/// Exit code of `hexwall quality` if a condition of --fail-if holds.
inline constexpr int quality_exit_code = 8;

/// `hexwall quality`: figures and histograms of a mesh of any tool.
Command add_quality(CLI::App& app);

}  // namespace hexwall
