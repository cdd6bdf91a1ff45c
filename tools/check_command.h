#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "command.h"
#include "input_options.h"

namespace hexwall {

/// The options of `hexwall check`.
struct CheckOptions {
  InputOptions input;
  std::string output;  ///< folder for check.json, problems.vtp, prepared.vtp; empty: none
  bool json = false;   ///< print JSON instead of words
};

void add_check_options(CLI::App& check, CheckOptions& options);

/// `check.json` of a surface, and nothing written.
nlohmann::ordered_json check_report(const CheckOptions& options, const PrepareOptions& preparation,
                                    ReadResult read);

/// `hexwall check`: what is wrong with a surface, and what becomes of it. Its exit code is that
/// with which `hexwall mesh` would refuse the surface.
Command add_check(CLI::App& app);

}  // namespace hexwall
