#pragma once

#include "surface/triangle_surface.h"

namespace hexwall {

/// Remeshes a surface isotropically, into near-equilateral triangles of the edge length `edge`.
/// Vertices lie on the input surface. The vertices of boundary loops stay; boundary edges longer
/// than 4/3 `edge` are split. \pre oriented manifold, each triangle has area, edge > 0.
TriangleSurface remesh(const TriangleSurface& surface, double edge);

}  // namespace hexwall
