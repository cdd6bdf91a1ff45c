#pragma once

#include "surface/triangle_surface.h"

namespace hexwall::test {

enum class CapStyle {
  fan,    ///< from one vertex of the loop
  wheel,  ///< around a vertex in the middle
  rings   ///< a ring of vertices half way to the middle, then a wheel
};

/// The surface with every boundary loop closed flat, its new triangles wound like the rest, after
/// those of the surface. \pre manifold.
TriangleSurface capped(const TriangleSurface& surface, CapStyle style);

}  // namespace hexwall::test
