#pragma once

#include <vector>

#include "pipeline.h"
#include "surface/projector.h"

namespace hexwall {

/// Target edge length at points of the surface.
std::vector<double> target_edges(const PipelineResult& result,
                                 const std::vector<SurfacePoint>& places);

/// \throws UsageError for layer options out of range.
void check_layer_options(const PipelineOptions& options);

/// The last stage of the pipeline: from the relaxed quads to hexahedra. Fills in all that
/// `PipelineResult` has from `radius` on. \param places of the quad mesh's vertices; updated.
/// \param radius of the vessel, at the vertices of the refined surface.
/// \throws UsageError for a thickness that is not positive somewhere, MeshingError if no valid wall
/// is found, or if it has to be thinner than asked and `thickness_strict` is set.
void make_wall(PipelineResult& result, std::vector<SurfacePoint>& places,
               const SurfaceProjector& projector, const std::vector<double>& radius);

}  // namespace hexwall
