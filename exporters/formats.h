#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipeline.h"

namespace hexwall {

/// A format of the hex mesh.
struct Format {
  std::string name;    ///< in `--write`
  std::string output;  ///< the file or folder it is written to
  /// \param metres_per_unit length of the result's unit in metres
  void (*write)(const std::filesystem::path& path, const PipelineResult& result,
                double metres_per_unit);
};

/// All formats in which the hex mesh can be written.
const std::vector<Format>& hex_mesh_formats();

}  // namespace hexwall
