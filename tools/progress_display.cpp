#include "progress_display.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <unistd.h>

#include <fmt/format.h>

namespace hexwall {
namespace {

constexpr int bar_width = 30;
constexpr const char* clear_line = "\r\033[K";

// Shares of the time, from runs on the surfaces of real vessels.
const std::vector<ProgressStage> surface_stages{
    {"read", 0.02},   {"prepare", 0.05}, {"form", 0.25}, {"foliation", 0.005},
    {"quads", 0.005}, {"relax", 0.13},   {"wall", 0.42},
};

std::vector<ProgressStage> with(const std::vector<ProgressStage>& more) {
  std::vector<ProgressStage> stages = surface_stages;
  stages.insert(stages.end(), more.begin(), more.end());
  return stages;
}

std::string time_text(double seconds) {
  const auto whole = static_cast<long>(std::ceil(seconds));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{}:{:02} min", whole / 60, whole % 60);
  return fmt::format("{}:{:02} h", whole / 3600, whole / 60 % 60);
}

}  // namespace

void ProgressEstimate::begin(const std::string& stage, double seconds) {
  const auto found = std::find_if(stages_.begin(), stages_.end(),
                                  [&](const ProgressStage& s) { return s.name == stage; });
  if (found == stages_.end()) return;
  fraction(seconds);
  current_ = static_cast<int>(found - stages_.begin());
  began_ = seconds;
}

double ProgressEstimate::weight_of(int first, int last) const {
  double sum = 0.0;
  for (int i = first; i < last; ++i) sum += stages_[i].weight;
  return sum;
}

double ProgressEstimate::rate() const {
  const double over = current_ > 0 ? weight_of(0, current_) : 0.0;
  // What little there is at first says nothing.
  constexpr double least_weight = 0.05;
  return over < least_weight ? 0.0 : began_ / over;
}

double ProgressEstimate::fraction(double seconds) {
  if (current_ < 0) return 0.0;
  const double expected = rate() * stages_[current_].weight;
  // A stage that takes longer than expected is never quite over.
  constexpr double most_of_stage = 0.95;
  const double of_stage =
      expected > 0.0 ? std::min(most_of_stage, (seconds - began_) / expected) : 0.0;
  const double done = weight_of(0, current_) + of_stage * stages_[current_].weight;
  greatest_ = std::max(greatest_, done / weight_of(0, count()));
  return greatest_;
}

double ProgressEstimate::remaining(double seconds) const {
  if (rate() <= 0.0) return -1.0;
  const double here = seconds - began_;
  const double expected = rate() * stages_[current_].weight;
  // Beyond what was expected it may go on for as long as a tenth of what it took.
  const double of_stage = std::max(expected - here, 0.1 * here);
  return of_stage + rate() * weight_of(current_ + 1, count());
}

ProgressDisplay::ProgressDisplay(bool enabled, const std::vector<ProgressStage>& more)
    : enabled_(enabled),
      is_terminal_(isatty(fileno(stderr)) != 0),
      start_(std::chrono::steady_clock::now()),
      estimate_(with(more)) {
  if (enabled_ && is_terminal_) thread_ = std::thread([this] { keep_drawing(); });
}

ProgressDisplay::~ProgressDisplay() {
  finish();
}

void ProgressDisplay::begin(const std::string& stage) {
  if (!enabled_) return;
  const std::lock_guard lock(mutex_);
  estimate_.begin(stage, seconds());
  stage_ = stage;
  detail_.clear();
  if (is_terminal_) {
    draw();
  } else {
    fmt::print(stderr, "[{}/{}] {}\n", estimate_.number(), estimate_.count(), stage);
  }
}

void ProgressDisplay::detail(const std::string& text) {
  const std::lock_guard lock(mutex_);
  detail_ = text;
  if (enabled_ && is_terminal_) draw();
}

void ProgressDisplay::finish() {
  {
    const std::lock_guard lock(mutex_);
    if (finished_) return;
    finished_ = true;
    if (enabled_ && is_terminal_) fmt::print(stderr, "{}", clear_line);
  }
  wake_.notify_all();
  if (thread_.joinable()) thread_.join();
}

double ProgressDisplay::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void ProgressDisplay::draw() {
  if (finished_ || stage_.empty()) return;
  const double fraction = estimate_.fraction(seconds());
  const double left = estimate_.remaining(seconds());
  const auto done = static_cast<std::size_t>(bar_width * fraction);
  fmt::print(stderr, "{}[{}{}] {:3.0f} %  {}{}{}", clear_line, std::string(done, '#'),
             std::string(bar_width - done, '-'), 100.0 * fraction, stage_,
             detail_.empty() ? "" : ": " + detail_,
             left < 0.0 ? "" : fmt::format(", about {} left", time_text(left)));
  std::fflush(stderr);
}

void ProgressDisplay::keep_drawing() {
  std::unique_lock lock(mutex_);
  while (!wake_.wait_for(lock, std::chrono::milliseconds(500), [this] { return finished_; })) {
    draw();
  }
}

}  // namespace hexwall
