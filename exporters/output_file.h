#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "exporters/text.h"

namespace hexwall {

/// Makes `bytes` the content of the file `path`, all of it or nothing: the bytes go to a temporary
/// file in the same folder, which then takes the place of `path`. An older file survives a failure.
/// \throw WriteError naming the path and the reason: no such folder, no permission, disk full.
void write_output_file(const std::filesystem::path& path, std::string_view bytes);

/// A file of a folder: its path below the folder and its content, the end of which may be made
/// while it is written, so that it is never in memory as a whole.
struct OutputFile {
  std::string path;
  std::string bytes;
  std::function<void(Text&)> append_rest = {};
};

/// Writes files that belong together into `folder`, which is made if missing, as are the folders in
/// the paths. Older files of the same names are replaced.
/// \throw WriteError if that fails; none of the files is left then, as a part of them could be
/// mistaken for the whole.
void write_output_files(const std::filesystem::path& folder, const std::vector<OutputFile>& files);

}  // namespace hexwall
