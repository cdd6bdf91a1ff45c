#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/progress.h"
#include "hex/cell_mesh.h"
#include "lumen/cell_quality.h"
#include "lumen/improve.h"
#include "lumen/lumen_opening.h"
#include "pipeline.h"

namespace hexwall {

struct LumenOptions {
  enum class Mesh {
    hybrid,  ///< layers of hexes at the wall, a pyramid on each, tetrahedra in the core
    tet      ///< tetrahedra only
  };
  Mesh mesh = Mesh::hybrid;
  std::string inlet;                  ///< name of an opening; empty: the largest
  std::optional<double> core_growth;  ///< tetrahedra's edges grow by this share of the distance;
                                      ///< default: 0.2 in a hybrid mesh, 0 without layers
  double seconds = 600.0;             ///< TetGen may take each time
};

/// How many cells of each shape there are.
struct CellCounts {
  int hexes = 0;
  int pyramids = 0;
  int tets = 0;
};

struct LumenResult {
  CellMesh mesh;
  std::vector<LumenOpening> openings;  ///< in the order of the pipeline's
  CellCounts counts;
  std::vector<CellQuality> quality;  ///< of each region
  ImproveResult improvement;
  int lowered_pyramids = 0;  ///< see `CoreSurface`
  double tetgen_seconds = 0.0;
  long tetgen_memory_bytes = 0;
  std::vector<std::string> warnings;
  std::vector<StageTime> times;
};

/// From the layers of hexes, or from the quads of the wall, to the mesh of the lumen.
///
/// Hybrid: the hexes of `result.wall`, a pyramid on each face of its patch `core`, tetrahedra
/// inside, caps on the openings. Patches are those of the hexes, without `core`, the openings' with
/// their caps; the additional zone `lumen_core` has pyramids and tetrahedra; with layers on both
/// sides the regions `lumen` and `wall` share the face zone `interface`.
/// Tet: patches `wall` (the quads, split) and those of the openings; zone `lumen_core`.
/// \pre hybrid: `result` has layers on the inner side, with `leaves_room_for_core`.
/// \throws UsageError if no opening has the name of the inlet; MeshingError, GeometryError, naming
/// the place, if the core can't be filled.
LumenResult make_lumen(const PipelineResult& result, const LumenOptions& options,
                       const ProgressCallback& progress = {});

}  // namespace hexwall
