#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <unistd.h>

namespace hexwall::test {

/// A file of this process, in memory where the system has a folder for that, because a fuzzer
/// writes thousands of them per second. Removed at the end of the scope.
class MemoryFile {
 public:
  explicit MemoryFile(const std::string& extension, std::string_view content = {}) {
    const std::filesystem::path memory = "/dev/shm";
    path_ = std::filesystem::is_directory(memory) ? memory : std::filesystem::temp_directory_path();
    path_ /= "hexwall-fuzz-" + std::to_string(getpid()) + extension;
    std::ofstream(path_, std::ios::binary) << content;
  }
  ~MemoryFile() {
    std::error_code error;
    std::filesystem::remove(path_, error);
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace hexwall::test
