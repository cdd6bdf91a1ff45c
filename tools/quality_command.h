#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace hexwall {

/// Exit code of `hexwall quality` if a condition of --fail-if holds.
inline constexpr int quality_exit_code = 8;

/// `hexwall quality`: figures and histograms of a mesh of any tool.
struct QualityCommand {
  std::string mesh;
  std::string output;                ///< JSON file; empty: none
  bool json = false;                 ///< print JSON instead of words
  std::vector<std::string> fail_if;  ///< see `Condition`
  std::size_t worst = 5;
};

CLI::App* add_quality(CLI::App& app, QualityCommand& command);

/// Prints the figures. \returns 0, or `quality_exit_code` if a condition holds.
/// \throws ReadError, UsageError, WriteError.
int run_quality(const QualityCommand& command);

}  // namespace hexwall
