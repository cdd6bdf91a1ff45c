#pragma once

#include <string>
#include <vector>

#include "core/errors.h"
#include "surface/connectivity.h"
#include "surface/triangle_surface.h"

namespace hexwall {

/// What keeps a surface from being meshed.
struct Problem {
  std::string kind;          ///< empty, not_finite, degenerate, components, nonmanifold_edges,
                             ///< not_orientable, nonmanifold_vertices, closed, genus,
                             ///< self_intersections
  ExitCode code;             ///< of the refusal
  std::string message;       ///< what is wrong, where, what to do
  std::vector<Vec3> places;  ///< all places, where there are any
};

/// All problems that `check_surface` would name, but for those that can't be looked for as long as
/// others are there: loops, handles and self-intersections of a surface that is not manifold.
/// \pre each index lies in [0, #V).
std::vector<Problem> find_problems(const TriangleSurface& surface);

struct CheckResult {
  TriangleSurface surface;         ///< the input, with all triangles wound outward
  Connectivity mesh;               ///< of `surface`
  int flipped = 0;                 ///< triangles whose winding was turned for that
  std::vector<std::string> notes;  ///< what the user should know, one sentence each
};

/// Checks that a surface is a valid vessel wall and winds its triangles counter-clockwise seen from
/// outside (see `orient`). Refuses, in this order and with the first few places named:
/// non-finite coordinates; triangles with a repeated vertex or without area; several connected
/// components; edges with more than two triangles; Möbius bands; vertices that join several fans;
/// fewer than two boundary loops; handles (genus > 0); self-intersections.
/// The last and most costly of these is left out if the caller knows that the surface
/// `is_free_of_intersections` (see `RepairResult`).
/// \pre each index lies in [0, #V). Points that no triangle uses are ignored.
/// \throws GeometryError, TopologyError as above.
CheckResult check_surface(const TriangleSurface& surface, bool is_free_of_intersections = false);

}  // namespace hexwall
