#pragma once

#include <filesystem>
#include <optional>

#include "interrupt.h"

namespace hexwall {

/// An output folder that fills all at once: files are written to a hidden folder inside it and
/// moved to their places by `commit`. Without `commit`, also if the program is interrupted, nothing
/// stays behind, not even the folder if it is new. Files already there are replaced only by files
/// of the same name.
class OutputFolder {
 public:
  /// \throws WriteError if the folder cannot be made or written to.
  explicit OutputFolder(const std::filesystem::path& folder);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  /// Where to write until `commit`.
  const std::filesystem::path& staging() const { return staging_; }
  const std::filesystem::path& path() const { return folder_; }

  /// \throws WriteError if a file cannot be moved.
  void commit();

 private:
  std::filesystem::path folder_;
  std::filesystem::path staging_;
  std::filesystem::path first_created_;  // topmost folder that did not exist before; may be empty
  std::optional<Cleanup> cleanup_;       // if the program is interrupted before `commit`
};

}  // namespace hexwall
