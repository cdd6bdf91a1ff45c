#pragma once

#include <string>
#include <sys/types.h>
#include <vector>

namespace hexwall {

/// Programs that hexwall runs. They end with it: `kill_children` ends those that run.
struct ChildOutcome {
  int exit_code = -1;  ///< -1 if it could not be started or was ended by a signal
  std::string output;  ///< what it said on both streams
};

/// Runs a program (looked for in PATH unless it has a slash) and waits for its end.
/// \param environment NAME=VALUE pairs beside those of this process.
ChildOutcome run_program(const std::vector<std::string>& command,
                         const std::vector<std::string>& environment = {});

/// Starts a program that outlives this one, such as a browser.
/// \returns false if it can't be started or fails within `seconds`.
bool start_program(const std::vector<std::string>& command, int seconds);

/// A program that runs beside this one until the end of the scope.
class Companion {
 public:
  /// Starts it with a pipe as file descriptor 3. \throws nothing: see `is_running`.
  explicit Companion(const std::vector<std::string>& command);
  ~Companion();
  Companion(const Companion&) = delete;
  Companion& operator=(const Companion&) = delete;

  bool is_running() const { return process_ > 0; }
  /// The first line that it writes to file descriptor 3; empty if it ends without, or does not
  /// write within `seconds`.
  std::string first_line(int seconds);

 private:
  pid_t process_ = -1;
  int pipe_ = -1;
};

/// Ends all that run. May be called from another thread.
void kill_children();

}  // namespace hexwall
