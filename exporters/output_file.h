#pragma once

#include <filesystem>
#include <string_view>

namespace hexwall {

/// Makes `bytes` the content of the file `path`, all of it or nothing: the bytes go to a temporary
/// file in the same folder, which then takes the place of `path`. An older file survives a failure.
/// \throw WriteError naming the path and the reason: no such folder, no permission, disk full.
void write_output_file(const std::filesystem::path& path, std::string_view bytes);

}  // namespace hexwall
