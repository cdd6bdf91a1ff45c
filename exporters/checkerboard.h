#pragma once

#include "exporters/vtk_files.h"
#include "pipeline.h"

namespace hexwall {

/// The surface with a checkerboard in its conformal map, as texture coordinates `uv`: one unit is
/// one tile.
struct Checkerboards {
  PolyData before;             ///< at the start of the best descent
  PolyData after;              ///< of the form of least energy
  double energy_before = 0.0;  ///< of the start
};

/// Circumferences are rounded to an even number of tiles, so that the boards close around the
/// vessel: pictures, not results.
Checkerboards checkerboards(const PipelineResult& result);

}  // namespace hexwall
