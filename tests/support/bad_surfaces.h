#pragma once

#include "surface/triangle_surface.h"

/// Small surfaces that are no vessel walls, one for each reason of refusal.
namespace hexwall::test {

TriangleSurface closed_surface();
TriangleSurface two_tubes();
TriangleSurface one_loop();
TriangleSurface mobius_band();
TriangleSurface tube_with_fin();     ///< an edge with three triangles
TriangleSurface torus_with_holes();  ///< two loops, genus 1
TriangleSurface not_a_number();
TriangleSurface self_intersecting();
TriangleSurface zero_area();  ///< triangles with two corners at the same place

}  // namespace hexwall::test
