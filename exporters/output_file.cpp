#include "exporters/output_file.h"

#include <cerrno>
#include <cstdio>
#include <ostream>
#include <streambuf>
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

/// A file that is written. It takes everything, and tells of what could not be written when it is
/// closed, with the reason, which C++ streams lose.
class FileBuffer : public std::streambuf {
 public:
  /// \param named in messages, in the place of `path`.
  FileBuffer(const std::filesystem::path& path, std::filesystem::path named)
      : named_(std::move(named)), file_(std::fopen(path.c_str(), "wb")) {
    if (file_ == nullptr) fail(named_, errno);
  }
  ~FileBuffer() override {
    if (file_ != nullptr) std::fclose(file_);
  }
  FileBuffer(const FileBuffer&) = delete;
  FileBuffer& operator=(const FileBuffer&) = delete;

  void close() {
    note(std::fclose(std::exchange(file_, nullptr)) == 0);
    if (error_ != 0) fail(named_, error_);
  }

 protected:
  std::streamsize xsputn(const char* bytes, std::streamsize size) override {
    const auto count = static_cast<std::size_t>(size);
    note(std::fwrite(bytes, 1, count, file_) == count);
    at_ += size;
    return size;
  }
  int_type overflow(int_type c) override {
    const char byte = traits_type::to_char_type(c);
    xsputn(&byte, 1);
    return c;
  }
  pos_type seekoff(off_type offset, std::ios_base::seekdir from, std::ios_base::openmode) override {
    const off_type to = from == std::ios_base::beg ? offset : at_ + offset;
    if (to != at_) note(::fseeko(file_, to, SEEK_SET) == 0);
    at_ = to;
    return at_;
  }
  pos_type seekpos(pos_type to, std::ios_base::openmode mode) override {
    return seekoff(to, std::ios_base::beg, mode);
  }

 private:
  void note(bool is_done) {
    if (!is_done && error_ == 0) error_ = errno;
  }

  std::filesystem::path named_;
  std::FILE* file_;
  off_type at_ = 0;
  int error_ = 0;  // of the first failure
};

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw WriteError("cannot make folder " + folder.string() + ": " + error.message());
}

}  // namespace

void write_output_file(const std::filesystem::path& path, std::string_view bytes) {
  write_output_file(path, [&](std::ostream& stream) { stream << bytes; });
}

void write_output_file(const std::filesystem::path& path, const ByteSource& source) {
  std::filesystem::path name = path;
  name += ".part" + std::to_string(::getpid());
  const TemporaryFile temporary(name);
  FileBuffer file(temporary.path(), path);
  std::ostream stream(&file);
  source(stream);
  file.close();
  std::error_code error;
  std::filesystem::rename(temporary.path(), path, error);
  if (error) fail(path, error.value());
}

void write_output_files(const std::filesystem::path& folder, const std::vector<OutputFile>& files) {
  try {
    for (const OutputFile& file : files) {
      make_folder((folder / file.path).parent_path());
      if (file.source) {
        write_output_file(folder / file.path, file.source);
      } else {
        write_output_file(folder / file.path, file.bytes);
      }
    }
  } catch (...) {
    std::error_code ignored;
    for (const OutputFile& file : files) std::filesystem::remove(folder / file.path, ignored);
    throw;
  }
}

}  // namespace hexwall
