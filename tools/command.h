#pragma once

#include <functional>

#include <CLI/CLI.hpp>

#include "core/errors.h"

namespace hexwall {

/// A command of the program: its options are registered already; `run` does it once they
/// are parsed.
struct Command {
  CLI::App* app;
  std::function<ExitCode()> run;  ///< \throws Error
};

}  // namespace hexwall
