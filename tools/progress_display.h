#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace hexwall {

/// A part of a run, and how long it takes compared with the others on an ordinary vessel.
struct ProgressStage {
  std::string name;
  double weight;
};

/// How far a run is, of the time that stages take in proportion to their weights. The stages that
/// are over say how fast this machine is on this surface.
class ProgressEstimate {
 public:
  explicit ProgressEstimate(std::vector<ProgressStage> stages) : stages_(std::move(stages)) {}

  /// A stage begins, `seconds` after the start. One that is not in the list goes on with the one
  /// before.
  void begin(const std::string& stage, double seconds);

  /// Share of the work that is done, 0 … 1; it never falls.
  double fraction(double seconds);

  /// Seconds that are left; negative if that can't be said yet.
  double remaining(double seconds) const;

  int number() const { return current_ + 1; }  ///< of the stage, from 1
  int count() const { return static_cast<int>(stages_.size()); }

 private:
  double weight_of(int first, int last) const;
  double rate() const;  ///< seconds per weight; 0 if unknown

  std::vector<ProgressStage> stages_;
  int current_ = -1;
  double began_ = 0.0;  ///< the current stage
  double greatest_ = 0.0;
};

/// Shows stages on standard error: on a terminal a bar with the share and the time that is left,
/// redrawn in place twice a second; elsewhere a line per stage.
class ProgressDisplay {
 public:
  /// \param more stages behind those of a surface that is meshed.
  explicit ProgressDisplay(bool enabled, const std::vector<ProgressStage>& more = {});
  ~ProgressDisplay();
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  void begin(const std::string& stage);
  void detail(const std::string& text);  ///< what the stage is at, shown on terminals
  void finish();                         ///< clears the bar

 private:
  double seconds() const;
  void draw();
  void keep_drawing();

  bool enabled_;
  bool is_terminal_;
  std::chrono::steady_clock::time_point start_;
  std::mutex mutex_;
  ProgressEstimate estimate_;  // guarded by the mutex, as all below
  std::string stage_, detail_;
  bool finished_ = false;
  std::condition_variable wake_;
  std::thread thread_;
};

}  // namespace hexwall
