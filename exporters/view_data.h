#pragma once

#include <string>

#include "pipeline.h"

namespace hexwall {

/// The mesh of a run as the 3-D view of the report takes it.
struct ViewData {
  std::string meta;    ///< JSON: what the data consists of; no '<' in it
  std::string base64;  ///< of the data, compressed by zlib
};

/// Points in single precision around their middle, corners of the hexes, and what they can be
/// coloured by: zone, region, scaled Jacobian; thickness and local radius at the points. Above
/// `most_hexes` hexes the quads instead, so that the page stays of a size that browsers open.
ViewData view_data(const PipelineResult& result, std::size_t most_hexes = 400000);

}  // namespace hexwall
