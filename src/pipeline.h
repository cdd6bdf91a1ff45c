#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/progress.h"
#include "dec/delaunay.h"
#include "foliation/foliation.h"
#include "foliation/row_spacing.h"
#include "hex/directions.h"
#include "hex/extrude.h"
#include "hex/polish.h"
#include "holomorphic/basis.h"
#include "holomorphic/form.h"
#include "holomorphic/optimum.h"
#include "quad/extract.h"
#include "quad/quality.h"
#include "quad/quantise.h"
#include "quad/relax.h"
#include "surface/connectivity.h"
#include "surface/triangle_surface.h"

namespace hexwall {

struct PipelineOptions {
  std::optional<double> size;       ///< target edge length; default sqrt(area / 20000)
  std::optional<double> thickness;  ///< of the wall; default 10 % of the mean vessel radius
  int layers = 3;
  double growth = 1.0;
  double relax = 0.5;  ///< 0 conformal sizes … 1 even sizes
};

/// A boundary loop of the input, the longest one first.
struct Opening {
  std::string name;
  double length = 0.0;
  LoopPlane plane;
};

/// Everything that the pipeline computes, stage by stage. Lengths are in the unit of the input.
struct PipelineResult {
  PipelineOptions options;  ///< with all defaults filled in
  TriangleSurface surface;  ///< the input, wound outward
  Connectivity connectivity;
  std::vector<Opening> openings;
  DelaunaySurface refined;
  Connectivity refined_connectivity;
  HolomorphicBasis basis;
  OptimumResult optimum;
  HolomorphicForm form;
  std::vector<double> scale_factor;  ///< |grad y| of each triangle of `refined`
  Foliation foliation;
  std::vector<RowSpacing> spacing;
  Quantisation numbers;
  ExtractResult conformal;  ///< quads at their conformal places
  QuadMesh quads;           ///< after relaxation and polishing
  RelaxResult relaxation;
  int smoothed_directions = 0;  ///< quad vertices not extruded along the surface's normal
  PolishResult polishing;
  QuadQuality quad_quality;
  ExtrudeResult wall;
  std::vector<std::string> warnings;
  std::vector<StageTime> times;
};

/// From a vessel surface to its hexahedral wall.
/// \throws UsageError for options out of range, GeometryError, TopologyError for surfaces that are
/// no vessel wall (see `check_surface`), MeshingError where no valid mesh is found.
PipelineResult run_pipeline(const TriangleSurface& surface, const PipelineOptions& options,
                            const ProgressCallback& progress = {});

}  // namespace hexwall
