// Ctrl-C and SIGTERM: the program ends soon, with its exit code, and leaves nothing behind.

#include <array>
#include <csignal>
#include <fcntl.h>
#include <filesystem>
#include <spawn.h>
#include <string>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

#include <gtest/gtest.h>

#include "program/program_fails.h"

namespace hexwall::test {
namespace {

namespace fs = std::filesystem;

/// A program whose error stream is read while it runs.
class Running {
 public:
  explicit Running(std::vector<std::string> command) {
    std::vector<char*> argv;
    for (std::string& word : command) argv.push_back(word.data());
    argv.push_back(nullptr);
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) return;
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    if (::posix_spawnp(&process_, argv[0], &actions, nullptr, argv.data(), environ) != 0) {
      process_ = -1;
    }
    posix_spawn_file_actions_destroy(&actions);
    ::close(ends[1]);
    errors_ = ends[0];
  }
  ~Running() { ::close(errors_); }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

  /// Reads up to these words. \returns false if the program ends before.
  bool wait_for(const std::string& words) {
    char letter = 0;
    while (said_.find(words) == std::string::npos) {
      if (::read(errors_, &letter, 1) != 1) return false;
      said_ += letter;
    }
    return true;
  }

  /// Sends a signal and waits for the end. \returns the exit code, -1 if the signal ended it.
  int end_with(int signal) {
    ::kill(process_, signal);
    wait_for("nothing ends with this");
    int status = 0;
    ::waitpid(process_, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  const std::string& said() const { return said_; }

 private:
  pid_t process_ = -1;
  int errors_ = -1;
  std::string said_;
};

class Interrupt : public ProgramFails {
 protected:
  // Fine enough to take a while, so that every stage can be met.
  Interrupt() { write_surface(surface_, generate_shape(shape_from_name("bifurcation"), 0.1)); }

  void expect_clean_end(const std::string& stage, int signal,
                        const std::vector<std::string>& more = {}) {
    const auto before = files();
    std::vector<std::string> command{HEXWALL_PROGRAM, "mesh",   surface_, "-o",
                                     output_,         "--size", "0.05"};
    command.insert(command.end(), more.begin(), more.end());
    Running program(command);
    ASSERT_TRUE(program.wait_for(stage)) << program.said();
    EXPECT_EQ(program.end_with(signal), 130) << program.said();
    EXPECT_NE(program.said().find("hexwall: stopped, nothing was written"), std::string::npos)
        << program.said();
    EXPECT_EQ(program.said().find("error"), std::string::npos) << program.said();
    EXPECT_EQ(files(), before);
  }
};

TEST_F(Interrupt, WhileMeshing) {
  expect_clean_end("] wall", SIGINT);
  expect_clean_end("] form", SIGTERM);
}

TEST_F(Interrupt, WhileWritingIntoAFolderThatIsThere) {
  fs::create_directories(output_);
  text_file("out/mine.txt", "kept");
  expect_clean_end("] write", SIGINT);
  EXPECT_EQ(bytes_of(fs::path(output_) / "mine.txt"), "kept");
}

TEST_F(Interrupt, WhileTakingPictures) {
  if (run_child({"sh", "-c", "command -v Xvfb"}).exit_code != 0) {
    GTEST_SKIP() << "Xvfb is not installed";
  }
  expect_clean_end("] pictures", SIGINT, {"--pictures"});
}

}  // namespace
}  // namespace hexwall::test
