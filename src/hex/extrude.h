#pragma once

#include <string>
#include <vector>

#include "hex/column.h"
#include "hex/hex_mesh.h"
#include "quad/quad_mesh.h"

namespace hexwall {

/// Extrudes a quad mesh along `directions` into layers of hexahedra, from the inner skin out.
///
/// Boundary patches, with the layers of `shape` on the outer side, the inner side, or both:
/// - the skins: inner_wall and outer_wall; core and wall; core and outer_wall;
/// - the end rings, one per boundary loop: its name; with layers on both sides that is the ring
///   inside, and NAME_wall the ring outside.
/// Regions are `wall` outside and `lumen` inside, in between is the face zone `interface`.
/// \param directions #V unit vectors, outward. \param loop_names one per boundary loop.
/// \pre all thicknesses give positive Jacobians, see `fit_thickness`.
HexMesh extrude(const QuadMesh& quads, const std::vector<Vec3>& directions,
                const std::vector<std::string>& loop_names, const WallShape& shape);

}  // namespace hexwall
