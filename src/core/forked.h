#pragma once

#include <functional>
#include <string>

namespace hexwall {

/// How a child process ended.
struct ForkedResult {
  bool finished = false;   ///< it returned its bytes
  bool timed_out = false;  ///< it was ended because the time was up
  int signal = 0;          ///< that ended it, if any: an abort, a segmentation fault
  std::string bytes;       ///< what `work` returned
  std::string output;      ///< the end of what it printed, to standard output or error
  double seconds = 0.0;    ///< wall time
  long memory_bytes = 0;   ///< its greatest resident memory, what it shares with this process
                           ///< included
};

/// Runs `work` in a copy of this process and hands back the bytes that it returns: whatever becomes
/// of the copy, this process goes on. For libraries that end the process on bad input.
/// `work` must not use threads if this process has used any: locks may be held by threads that the
/// copy does not have. What `work` throws counts as not finished; its message is in `output`.
/// \param seconds the copy is ended after this time.
/// \throws std::system_error if the process can't be copied.
ForkedResult run_forked(const std::function<std::string()>& work, double seconds);

}  // namespace hexwall
