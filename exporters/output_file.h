#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

namespace hexwall {

/// Makes `bytes` the content of the file `path`, all of it or nothing: the bytes go to a temporary
/// file in the same folder, which then takes the place of `path`. An older file survives a failure.
/// \throw WriteError naming the path and the reason: no such folder, no permission, disk full.
void write_output_file(const std::filesystem::path& path, std::string_view bytes);

/// Puts bytes into a stream that is at its beginning, and may go back in it. The stream takes all
/// of them even if the file can no longer be written.
using ByteSource = std::function<void(std::ostream&)>;

/// The same with bytes that are never in memory as a whole.
void write_output_file(const std::filesystem::path& path, const ByteSource& source);

/// A file of a folder: its path below the folder and its content, which may also be made while it
/// is written.
struct OutputFile {
  std::string path;
  std::string bytes;
  ByteSource source = {};  ///< in the place of `bytes`
};

/// Writes files that belong together into `folder`, which is made if missing, as are the folders in
/// the paths. Older files of the same names are replaced.
/// \throw WriteError if that fails; none of the files is left then, as a part of them could be
/// mistaken for the whole.
void write_output_files(const std::filesystem::path& folder, const std::vector<OutputFile>& files);

}  // namespace hexwall
