#pragma once

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "pipeline.h"
#include "surface/read.h"

namespace hexwall {

/// The options that say which layers of hexes are made on which side of the surface.
struct LayerCommandOptions {
  std::string side = "out";
  LayerOptions layers;  ///< of the side, or of the outer one of both
  std::string thickness_array;
  std::string thickness_file;
  std::string layer_spec;
  LayerOptions inner;  ///< with `side` both: of the inner one
  bool strict = false;
};

void add_layer_options(CLI::App& command, LayerCommandOptions& options);

/// Enters what they mean into `pipeline`, files read. \param prepared the surface to be meshed.
/// \throws UsageError, ReadError.
void set_layer_options(const LayerCommandOptions& options, const ReadResult& read,
                       const TriangleSurface& prepared, PipelineOptions& pipeline);

}  // namespace hexwall
