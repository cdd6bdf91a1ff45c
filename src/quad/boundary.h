#pragma once

#include <array>
#include <vector>

#include "quad/quad_mesh.h"

namespace hexwall {

/// Side k of a quad, from its corner k to the next one.
struct QuadSide {
  int quad;
  int side;
};

/// The sides that belong to one quad only, by quad and side.
std::vector<QuadSide> boundary_sides(const QuadMesh& mesh);

/// The two vertices of a side, in the quad's direction.
std::array<int, 2> ends_of(const QuadMesh& mesh, const QuadSide& side);

}  // namespace hexwall
