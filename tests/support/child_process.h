#pragma once

#include <string>
#include <vector>

namespace hexwall::test {

struct ChildResult {
  int exit_code = -1;  ///< -1 if the process could not be started or was ended by a signal
  std::string out, err;
};

/// Runs a program (looked for in PATH unless it has a slash) and waits for its end.
ChildResult run_child(const std::vector<std::string>& command);

/// Runs `hexwall` with the given arguments.
ChildResult run_hexwall(std::vector<std::string> arguments);

}  // namespace hexwall::test
