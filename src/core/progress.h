#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace hexwall {

/// Called when a stage begins: its name, its number from 0, and how many there are.
using ProgressCallback = std::function<void(const std::string& stage, int index, int count)>;

/// Wall time of each stage, in the order in which they ran.
struct StageTime {
  std::string stage;
  double seconds;
};

/// Announces stages and takes their times.
class StageClock {
 public:
  StageClock(ProgressCallback callback, int stage_count)
      : callback_(std::move(callback)), stage_count_(stage_count) {}

  void begin(const std::string& stage) {
    end();
    if (callback_) callback_(stage, static_cast<int>(times_.size()), stage_count_);
    times_.push_back({stage, 0.0});
    start_ = Clock::now();
    running_ = true;
  }

  void end() {
    if (!running_) return;
    times_.back().seconds = std::chrono::duration<double>(Clock::now() - start_).count();
    running_ = false;
  }

  const std::vector<StageTime>& times() const { return times_; }

 private:
  using Clock = std::chrono::steady_clock;
  ProgressCallback callback_;
  int stage_count_;
  std::vector<StageTime> times_;
  Clock::time_point start_;
  bool running_ = false;
};

}  // namespace hexwall
