#pragma once

#include <CLI/CLI.hpp>

#include "command.h"

namespace hexwall {

inline constexpr int condition_holds_exit_code = 8;

/// `hexwall quality`: figures and histograms of a mesh of any tool. Ends with code 8 if a condition
/// of --fail-if holds.
Command add_quality(CLI::App& app);

}  // namespace hexwall
