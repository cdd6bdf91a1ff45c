#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipeline.h"

namespace hexwall {

/// A picture to be taken: what `hexwall-picture` is told.
struct PictureScene {
  std::string name;                    ///< of the picture, without extension
  std::string caption;                 ///< one sentence
  std::vector<std::string> arguments;  ///< all but the output file
};

/// The pictures of a run: the input with openings and poles, the checkerboard before and after the
/// optimisation, the quads, the wall cut open, scaled Jacobians, the thickness given / asked.
/// Writes the files that they show into `folder`. \throws WriteError
std::vector<PictureScene> write_picture_scenes(const std::filesystem::path& folder,
                                               const PipelineResult& result);

}  // namespace hexwall
