#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "core/errors.h"
#include "input_options.h"

namespace hexwall {

/// `hexwall check`: what is wrong with a surface, and what becomes of it.
struct CheckCommand {
  InputOptions input;
  std::string output;  ///< folder for check.json, problems.vtp, prepared.vtp; empty: none
  bool json = false;   ///< print JSON instead of words
};

CLI::App* add_check(CLI::App& app, CheckCommand& command);

/// Prints the diagnosis. \returns success, or what `hexwall mesh` would refuse the surface with.
/// \throws ReadError, UsageError, WriteError.
ExitCode run_check(const CheckCommand& command);

}  // namespace hexwall
