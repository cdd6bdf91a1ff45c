#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "inspect/any_mesh.h"
#include "inspect/cell_metrics.h"
#include "inspect/distribution.h"
#include "inspect/foam_metrics.h"

namespace hexwall {

/// An element, face or cell that is among the worst by a measure.
struct WorstPlace {
  std::string what;  ///< such as "hexahedron", and its number in the file
  std::int64_t label;
  Vec3 at;  ///< its centre
  double value;
};

struct MetricResult {
  CellMetric metric;
  Distribution all;
  std::vector<std::pair<ElementShape, Distribution>> by_shape;
  std::vector<WorstPlace> worst;  ///< the worst first
};

struct FoamResult {
  FoamMetric metric;
  std::vector<WorstPlace> worst;  ///< beyond the threshold, or the worst one if none is
};

/// All that is measured of a mesh: of its cells if it has any, else of its triangles, quads and
/// polygons.
struct MeshQuality {
  std::size_t points = 0;
  std::array<std::size_t, element_shapes> count{};
  bool is_of_volume = false;
  std::vector<MetricResult> metrics;  ///< those that some element has
  Distribution corner_angle;          ///< at all corners of all faces of elements
  Distribution log_edge_ratio;        ///< of edges that meet in such a corner
  std::vector<FoamResult> foam;       ///< of a mesh of cells
  std::vector<std::string> notes;
};

/// \param worst as many of the worst places are kept of each measure.
MeshQuality mesh_quality(const AnyMesh& mesh, std::size_t worst = 5);

/// Named numbers of a mesh, for conditions: "min_scaled_jacobian", "hexahedron.max_skew",
/// "openfoam.max_nonOrthoAngle", "openfoam.nonOrthoFaces", "cells", …
using Figures = std::vector<std::pair<std::string, double>>;

Figures figures_of(const MeshQuality& quality);

/// Everything as JSON; README.md says what the keys are.
nlohmann::ordered_json to_json(const MeshQuality& quality);

/// The parts of a histogram as JSON: `low`, `width` and `counts` of its bins.
nlohmann::ordered_json to_json(const Distribution& d);

}  // namespace hexwall
