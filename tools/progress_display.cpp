#include "progress_display.h"

#include <cstdio>
#include <unistd.h>

#include <fmt/format.h>

namespace hexwall {
namespace {
constexpr int bar_width = 30;
constexpr const char* clear_line = "\r\033[K";
}  // namespace

ProgressDisplay::ProgressDisplay(bool enabled)
    : enabled_(enabled), is_terminal_(isatty(fileno(stderr)) != 0) {}

void ProgressDisplay::show(const std::string& stage, int index, int count) {
  if (!enabled_) return;
  if (!is_terminal_) {
    fmt::print(stderr, "[{}/{}] {}\n", index + 1, count, stage);
    return;
  }
  const int done = bar_width * index / count;
  fmt::print(stderr, "{}[{}{}] {}/{} {}", clear_line, std::string(done, '#'),
             std::string(bar_width - done, '-'), index + 1, count, stage);
  std::fflush(stderr);
}

void ProgressDisplay::finish() {
  if (enabled_ && is_terminal_) fmt::print(stderr, "{}", clear_line);
}

}  // namespace hexwall
