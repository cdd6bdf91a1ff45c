#pragma once

#include "surface/triangle_surface.h"
#include "surface/vessel_field.h"

namespace hexwall {

/// Remeshes a surface near the zero set of `field` into near-equilateral triangles of the edge
/// length `edge`. Interior vertices end on the zero set, each boundary vertex also in the plane of
/// the nearest open end.
/// \pre manifold, one boundary loop at each open end of the field.
TriangleSurface remesh_on_field(const TriangleSurface& surface, const VesselField& field,
                                double edge);

}  // namespace hexwall
