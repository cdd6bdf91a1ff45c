#include "surface/file_content.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <system_error>

#include "core/errors.h"

namespace hexwall {

namespace fs = std::filesystem;

void check_file(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) throw ReadError("the file does not exist");
  if (fs::is_directory(status)) throw ReadError("this is a directory; a file is needed");
  if (fs::file_size(path, error) == 0 && !error) throw ReadError("the file is empty");
  if (!std::ifstream(path)) throw ReadError("the file cannot be opened; check its permissions");
}

std::string content_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string content;
  std::error_code unknown;
  const std::uintmax_t size = fs::file_size(path, unknown);
  if (!unknown) content.reserve(size + 1);
  std::array<char, std::size_t{64} << 10> piece;
  while (file) {
    file.read(piece.data(), piece.size());
    content.append(piece.data(), static_cast<std::size_t>(file.gcount()));
  }
  if (!file.eof()) throw ReadError("the file could not be read");
  return content;
}

}  // namespace hexwall
