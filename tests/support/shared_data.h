#pragma once

#include <cstdlib>
#include <filesystem>
#include <optional>

namespace hexwall::test {

/// Folder of real vessel surfaces that are too large, or not free, to be part of the project: the
/// environment variable HEXWALL_SHARED_DATA, or else the compile definition of the same name.
/// Nothing where there is no such folder; tests then skip.
inline std::optional<std::filesystem::path> shared_data() {
  std::filesystem::path folder;
  if (const char* variable = std::getenv("HEXWALL_SHARED_DATA")) {
    folder = variable;
  } else {
#ifdef HEXWALL_SHARED_DATA
    folder = HEXWALL_SHARED_DATA;
#endif
  }
  std::error_code error;
  if (folder.empty() || !std::filesystem::is_directory(folder, error)) return std::nullopt;
  return folder;
}

}  // namespace hexwall::test
