#pragma once

#include <array>
#include <string>
#include <vector>

#include "lumen/caps.h"
#include "quad/quad_mesh.h"
#include "surface/triangle_surface.h"

namespace hexwall {

/// The closed surface around what is filled with tetrahedra: the split or pyramid-covered quads of
/// a skin, and the caps of its loops.
struct CoreSurface {
  TriangleSurface surface;   ///< vertices: those of the quads, apexes (one a quad, or none), caps
  std::vector<double> edge;  ///< #V wanted edge length
  std::vector<int> opening;  ///< #T opening that a triangle caps, or -1
  int first_apex = 0;        ///< vertex of the apex on quad 0
  int first_cap_point = 0;   ///< vertex of the first point inside a cap
  bool has_apexes = false;
  int lowered = 0;  ///< apexes that are lower than their quads would allow, for room
};

/// Loops of a quad mesh by `loop_of_vertex`, each counter-clockwise seen from outside the lumen, as
/// the rim of a cap has to be.
std::vector<std::vector<int>> cap_rims(const QuadMesh& quads);

/// Quads that are split into two triangles each along the shorter diagonal, and caps.
/// \param names of the loops. \throws MeshingError, see `fill_loop`.
CoreSurface split_surface(const QuadMesh& quads, const std::vector<std::string>& names);

/// Quads with a pyramid on each, its apex inside, and caps. Apexes are so low that the pyramids,
/// with a clearance, don't meet each other or the caps.
/// \throws MeshingError, naming the place, if there is no room for pyramids; see `fill_loop`.
CoreSurface pyramid_surface(const QuadMesh& quads, const std::vector<std::string>& names);

}  // namespace hexwall
