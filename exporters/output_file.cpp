#include "exporters/output_file.h"

#include <cerrno>
#include <cstdio>
#include <memory>
#include <string>
#include <system_error>
#include <unistd.h>

#include "core/errors.h"

namespace hexwall {
namespace {

/// Removes a file on leaving the scope. Harmless once the file has been renamed.
class TemporaryFile {
 public:
  explicit TemporaryFile(std::filesystem::path path) : path_(std::move(path)) {}
  ~TemporaryFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

[[noreturn]] void fail(const std::filesystem::path& path, int error) {
  throw WriteError("cannot write " + path.string() + ": " + std::generic_category().message(error));
}

/// 0, or the error number of the first step that failed.
int write_all(const std::filesystem::path& path, std::string_view bytes) {
  // C streams report the reason of a failure in errno; C++ streams lose it.
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (file == nullptr) return errno;
  std::setvbuf(file, nullptr, _IONBF, 0);
  const bool complete = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
  const int write_error = complete ? 0 : errno;
  const int close_error = std::fclose(file) == 0 ? 0 : errno;
  return complete ? close_error : write_error;
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw WriteError("cannot make folder " + folder.string() + ": " + error.message());
}

}  // namespace

void write_output_file(const std::filesystem::path& path, std::string_view bytes) {
  std::filesystem::path name = path;
  name += ".part" + std::to_string(::getpid());
  const TemporaryFile temporary(name);
  if (const int error = write_all(temporary.path(), bytes); error != 0) fail(path, error);
  std::error_code error;
  std::filesystem::rename(temporary.path(), path, error);
  if (error) fail(path, error.value());
}

void write_output_files(const std::filesystem::path& folder, const std::vector<OutputFile>& files) {
  try {
    for (const OutputFile& file : files) {
      make_folder((folder / file.path).parent_path());
      write_output_file(folder / file.path, file.bytes);
    }
  } catch (const WriteError&) {
    std::error_code ignored;
    for (const OutputFile& file : files) std::filesystem::remove(folder / file.path, ignored);
    throw;
  }
}

}  // namespace hexwall
