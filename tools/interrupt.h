#pragma once

#include <functional>
#include <mutex>

namespace hexwall {

inline constexpr int interrupted_exit_code = 130;

/// From now on Ctrl-C (SIGINT) and SIGTERM end the program in order: what `Cleanup` objects say is
/// done, programs that were started are ended, and the exit code is `interrupted_exit_code`.
/// To be called before any thread is started.
void handle_interrupts();

/// What is to be done if the program is interrupted before the end of the scope.
class Cleanup {
 public:
  /// \param work is called by another thread, while that of the scope goes on.
  explicit Cleanup(std::function<void()> work);
  ~Cleanup();
  Cleanup(const Cleanup&) = delete;
  Cleanup& operator=(const Cleanup&) = delete;

 private:
  std::function<void()> work_;
};

/// The program is not interrupted while the lock is held. What begins holding it when the program
/// is being interrupted never gets it.
std::unique_lock<std::mutex> hold_interrupts();

/// Does not return if the program is being interrupted: errors that come of the clean-up are no
/// news.
void wait_if_interrupted();

}  // namespace hexwall
