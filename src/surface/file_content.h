#pragma once

#include <filesystem>
#include <string>

namespace hexwall {

/// \throws ReadError if the file is missing, a directory, empty, or cannot be opened.
void check_file(const std::filesystem::path& path);

/// The bytes of a file. \throws ReadError if they cannot be read.
std::string content_of(const std::filesystem::path& path);

}  // namespace hexwall
