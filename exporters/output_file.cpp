#include "exporters/output_file.h"

#include <cerrno>
#include <cstdio>
#include <string>
#include <system_error>
#include <unistd.h>
#include <utility>

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

/// A file that is written from its beginning to its end. C streams report the reason of a failure
/// in errno; C++ streams lose it.
class Stream {
 public:
  /// \param named in messages, in the place of `path`.
  Stream(const std::filesystem::path& path, std::filesystem::path named)
      : named_(std::move(named)), file_(std::fopen(path.c_str(), "wb")) {
    if (file_ == nullptr) fail(named_, errno);
    std::setvbuf(file_, nullptr, _IONBF, 0);
  }
  ~Stream() {
    if (file_ != nullptr) std::fclose(file_);
  }
  Stream(const Stream&) = delete;
  Stream& operator=(const Stream&) = delete;

  void write(std::string_view bytes) {
    if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) fail(named_, errno);
  }
  void close() {
    if (std::fclose(std::exchange(file_, nullptr)) != 0) fail(named_, errno);
  }

 private:
  std::filesystem::path named_;
  std::FILE* file_;
};

// \param append_rest appends what follows `bytes`, if it is there.
void write_file(const std::filesystem::path& path, std::string_view bytes,
                const std::function<void(Text&)>& append_rest) {
  std::filesystem::path name = path;
  name += ".part" + std::to_string(::getpid());
  const TemporaryFile temporary(name);
  Stream stream(temporary.path(), path);
  stream.write(bytes);
  if (append_rest) {
    Text text([&](std::string_view piece) { stream.write(piece); });
    append_rest(text);
    text.pass_on();
  }
  stream.close();
  std::error_code error;
  std::filesystem::rename(temporary.path(), path, error);
  if (error) fail(path, error.value());
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw WriteError("cannot make folder " + folder.string() + ": " + error.message());
}

}  // namespace

void write_output_file(const std::filesystem::path& path, std::string_view bytes) {
  write_file(path, bytes, {});
}

void write_output_files(const std::filesystem::path& folder, const std::vector<OutputFile>& files) {
  try {
    for (const OutputFile& file : files) {
      make_folder((folder / file.path).parent_path());
      write_file(folder / file.path, file.bytes, file.append_rest);
    }
  } catch (...) {
    std::error_code ignored;
    for (const OutputFile& file : files) std::filesystem::remove(folder / file.path, ignored);
    throw;
  }
}

}  // namespace hexwall
