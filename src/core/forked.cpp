#include "core/forked.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <exception>
#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>

namespace hexwall {
namespace {

constexpr std::size_t kept_output = 2000;
constexpr std::size_t chunk = 1 << 16;

struct Pipe {
  int read_end = -1;
  int write_end = -1;

  Pipe() {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) {
      throw std::system_error(errno, std::generic_category(), "no pipe to a child process");
    }
    read_end = ends[0];
    write_end = ends[1];
  }
  ~Pipe() {
    close_end(read_end);
    close_end(write_end);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  static void close_end(int& end) {
    if (end >= 0) close(end);
    end = -1;
  }
};

void write_all(int file, const std::string& bytes) {
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t n = write(file, bytes.data() + done, bytes.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) _exit(1);
    done += static_cast<std::size_t>(n);
  }
}

[[noreturn]] void be_child(const std::function<std::string()>& work, Pipe& result, Pipe& output) {
  for (const int signal : {SIGABRT, SIGSEGV, SIGFPE, SIGBUS, SIGILL, SIGTERM, SIGINT}) {
    std::signal(signal, SIG_DFL);
  }
  const rlimit none{0, 0};
  setrlimit(RLIMIT_CORE, &none);
  dup2(output.write_end, STDOUT_FILENO);
  dup2(output.write_end, STDERR_FILENO);
  std::string bytes;
  try {
    bytes = work();
  } catch (const std::exception& error) {
    std::fflush(nullptr);
    write_all(STDERR_FILENO, error.what());
    _exit(1);
  } catch (...) {
    _exit(1);
  }
  std::fflush(nullptr);
  write_all(result.write_end, bytes);
  _exit(0);
}

// Appends what there is to read. \returns false at the end.
bool drain(int file, std::string& bytes) {
  std::array<char, chunk> buffer;
  const ssize_t n = read(file, buffer.data(), buffer.size());
  if (n < 0) return errno == EINTR || errno == EAGAIN;
  bytes.append(buffer.data(), static_cast<std::size_t>(n));
  return n > 0;
}

// Reads both pipes until the child closes them or the time is up. \returns false if it is up.
bool listen(Pipe& result, Pipe& output, double seconds, ForkedResult& r) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration<double>(seconds);
  while (result.read_end >= 0 || output.read_end >= 0) {
    const double left = std::chrono::duration<double>(end - Clock::now()).count();
    if (left <= 0.0) return false;
    std::array<pollfd, 2> files{pollfd{result.read_end, POLLIN, 0},
                                pollfd{output.read_end, POLLIN, 0}};
    const int wait = static_cast<int>(std::min(1000.0 * left + 1.0, 60000.0));
    if (poll(files.data(), files.size(), wait) <= 0) continue;
    if (files[0].revents != 0 && !drain(result.read_end, r.bytes)) Pipe::close_end(result.read_end);
    if (files[1].revents != 0 && !drain(output.read_end, r.output)) {
      Pipe::close_end(output.read_end);
    }
    if (r.output.size() > 2 * kept_output) r.output.erase(0, r.output.size() - kept_output);
  }
  return true;
}

}  // namespace

ForkedResult run_forked(const std::function<std::string()>& work, double seconds) {
  const auto start = std::chrono::steady_clock::now();
  ForkedResult r;
  Pipe result;
  Pipe output;
  std::fflush(nullptr);  // or the copy would write what waits to be written once more
  const pid_t child = fork();
  if (child < 0) throw std::system_error(errno, std::generic_category(), "no child process");
  if (child == 0) be_child(work, result, output);
  Pipe::close_end(result.write_end);
  Pipe::close_end(output.write_end);
  r.timed_out = !listen(result, output, seconds, r);
  if (r.timed_out) kill(child, SIGKILL);
  int status = 0;
  rusage usage{};
  while (wait4(child, &status, 0, &usage) < 0 && errno == EINTR) {
  }
  r.finished = !r.timed_out && WIFEXITED(status) && WEXITSTATUS(status) == 0;
  if (WIFSIGNALED(status)) r.signal = WTERMSIG(status);
  r.memory_bytes = usage.ru_maxrss * 1024;  // Linux gives kibibytes
  r.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return r;
}

}  // namespace hexwall
