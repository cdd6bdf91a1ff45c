#include "interrupt.h"

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <thread>
#include <unistd.h>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "child_process.h"

namespace hexwall {
namespace {

// Never destroyed: the thread that waits for signals outlives all objects.
struct Interrupts {
  std::mutex mutex;
  std::vector<const std::function<void()>*> cleanups;  // guarded by the mutex
};

Interrupts& interrupts() {
  static auto* const state = new Interrupts;
  return *state;
}

[[noreturn]] void stop() {
  // Held to the end: no result is moved to its place and no object is taken away any more.
  interrupts().mutex.lock();
  kill_children();
  auto& cleanups = interrupts().cleanups;
  std::for_each(cleanups.rbegin(), cleanups.rend(), [](const auto* work) { (*work)(); });
  if (isatty(fileno(stderr)) != 0) fmt::print(stderr, "\r\033[K");
  fmt::print(stderr, "hexwall: stopped, nothing was written\n");
  std::fflush(nullptr);
  ::_exit(interrupted_exit_code);
}

}  // namespace

void handle_interrupts() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  std::thread([signals] {
    int signal = 0;
    if (sigwait(&signals, &signal) == 0) stop();
  }).detach();
}

Cleanup::Cleanup(std::function<void()> work) : work_(std::move(work)) {
  const std::lock_guard lock(interrupts().mutex);
  interrupts().cleanups.push_back(&work_);
}

Cleanup::~Cleanup() {
  const std::lock_guard lock(interrupts().mutex);
  auto& cleanups = interrupts().cleanups;
  cleanups.erase(std::remove(cleanups.begin(), cleanups.end(), &work_), cleanups.end());
}

std::unique_lock<std::mutex> hold_interrupts() {
  return std::unique_lock(interrupts().mutex);
}

void wait_if_interrupted() {
  const std::lock_guard lock(interrupts().mutex);
}

}  // namespace hexwall
