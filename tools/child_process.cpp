#include "child_process.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <mutex>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace hexwall {
namespace {

std::mutex children_mutex;
std::vector<pid_t> children;  // that run, guarded by the mutex

void forget(pid_t process) {
  const std::lock_guard lock(children_mutex);
  children.erase(std::remove(children.begin(), children.end(), process), children.end());
}

struct Pipe {
  std::array<int, 2> ends{-1, -1};
  bool open() { return ::pipe2(ends.data(), O_CLOEXEC) == 0; }
};

std::vector<char*> pointers(std::vector<std::string>& words) {
  std::vector<char*> result;
  for (std::string& word : words) result.push_back(word.data());
  result.push_back(nullptr);
  return result;
}

std::vector<std::string> environment_with(const std::vector<std::string>& more) {
  std::vector<std::string> all = more;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string text = *entry;
    const std::string name = text.substr(0, text.find('=') + 1);
    const bool is_replaced = std::any_of(more.begin(), more.end(),
                                         [&](const std::string& m) { return m.starts_with(name); });
    if (!is_replaced) all.push_back(text);
  }
  return all;
}

// Starts a program in a group of its own, so that signals of the terminal reach this one alone.
// \param descriptors of this process and those that they become. \returns -1 on failure.
pid_t start(const std::vector<std::string>& command, const std::vector<std::string>& environment,
            const std::vector<std::array<int, 2>>& descriptors) {
  std::vector<std::string> words = command;
  std::vector<std::string> variables = environment_with(environment);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  for (const auto& [from, to] : descriptors) posix_spawn_file_actions_adddup2(&actions, from, to);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t none;
  sigemptyset(&none);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setpgroup(&attributes, 0);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETPGROUP);
  pid_t process = -1;
  const std::lock_guard lock(children_mutex);
  const int failure = ::posix_spawnp(&process, words[0].c_str(), &actions, &attributes,
                                     pointers(words).data(), pointers(variables).data());
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  if (failure != 0) return -1;
  children.push_back(process);
  return process;
}

void read_all(int from, std::string& text) {
  std::array<char, 4096> buffer;
  for (;;) {
    const ssize_t n = ::read(from, buffer.data(), buffer.size());
    if (n <= 0) return;
    text.append(buffer.data(), static_cast<std::size_t>(n));
  }
}

}  // namespace

ChildOutcome run_program(const std::vector<std::string>& command,
                         const std::vector<std::string>& environment) {
  ChildOutcome outcome;
  Pipe pipe;
  if (!pipe.open()) return outcome;
  const pid_t process =
      start(command, environment, {{pipe.ends[1], STDOUT_FILENO}, {pipe.ends[1], STDERR_FILENO}});
  ::close(pipe.ends[1]);
  if (process > 0) {
    read_all(pipe.ends[0], outcome.output);
    int status = 0;
    if (::waitpid(process, &status, 0) == process && WIFEXITED(status)) {
      outcome.exit_code = WEXITSTATUS(status);
    }
    forget(process);
  }
  ::close(pipe.ends[0]);
  return outcome;
}

bool start_program(const std::vector<std::string>& command, int seconds) {
  const int silence = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  const pid_t process = start(command, {}, {{silence, STDOUT_FILENO}, {silence, STDERR_FILENO}});
  ::close(silence);
  if (process < 0) return false;
  forget(process);
  constexpr int checks_per_second = 20;
  for (int i = 0; i < checks_per_second * seconds; ++i) {
    int status = 0;
    if (::waitpid(process, &status, WNOHANG) == process) {
      return WIFEXITED(status) && WEXITSTATUS(status) == 0;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1000 / checks_per_second));
  }
  return true;
}

Companion::Companion(const std::vector<std::string>& command) {
  Pipe pipe;
  if (!pipe.open()) return;
  const int silence = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  process_ =
      start(command, {}, {{pipe.ends[1], 3}, {silence, STDOUT_FILENO}, {silence, STDERR_FILENO}});
  ::close(silence);
  ::close(pipe.ends[1]);
  pipe_ = pipe.ends[0];
}

Companion::~Companion() {
  if (pipe_ >= 0) ::close(pipe_);
  if (process_ <= 0) return;
  ::kill(process_, SIGTERM);
  ::waitpid(process_, nullptr, 0);
  forget(process_);
}

std::string Companion::first_line(int seconds) {
  std::string line;
  pollfd waiting{pipe_, POLLIN, 0};
  while (pipe_ >= 0 && ::poll(&waiting, 1, 1000 * seconds) > 0) {
    char letter = 0;
    if (::read(pipe_, &letter, 1) != 1) return {};
    if (letter == '\n') return line;
    line += letter;
  }
  return {};
}

void kill_children() {
  const std::lock_guard lock(children_mutex);
  for (const pid_t process : children) ::kill(process, SIGTERM);
}

}  // namespace hexwall
