#pragma once

#include <string>

namespace hexwall {

/// Shows stages on standard error: a bar that is redrawn in place on a terminal, a line per stage
/// elsewhere.
class ProgressDisplay {
 public:
  explicit ProgressDisplay(bool enabled);
  void show(const std::string& stage, int index, int count);
  void finish();  ///< clears the bar

 private:
  bool enabled_;
  bool is_terminal_;
};

}  // namespace hexwall
