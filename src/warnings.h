#pragma once

#include "pipeline.h"

namespace hexwall {

/// Adds to `result.warnings` what to know before using the mesh, each with its place.
void add_warnings(PipelineResult& result);

}  // namespace hexwall
