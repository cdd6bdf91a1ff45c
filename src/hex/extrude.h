#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hex/hex_mesh.h"
#include "quad/quad_mesh.h"

namespace hexwall {

struct ExtrudeOptions {
  double thickness = 1.0;  ///< in the mesh's length unit, > 0
  int layers = 3;          ///< >= 1
  double growth = 1.0;     ///< ratio of the heights of successive layers, from the lumen out, > 0
  double wanted_scaled_jacobian = 0.2;  ///< thickness is reduced where a hex falls below this
};

struct ExtrudeResult {
  HexMesh mesh;
  std::vector<double> thickness;        ///< #V of the quad mesh: thickness given
  std::vector<double> scaled_jacobian;  ///< #H
  double min_scaled_jacobian = 0.0;
  double thickness_min = 0.0;
  double reduced_area_fraction =
      0.0;                ///< share of the surface with less than 99 % of the thickness
  int worst_vertex = -1;  ///< quad vertex of least thickness
};

/// Extrudes a quad mesh outward along `directions` into layers of hexahedra.
///
/// Where a hex would have a corner of scaled Jacobian below what is wanted, the thickness is
/// reduced there, smoothly, until all corners are fine: no layer is ever dropped. A quad that is
/// itself worse than wanted keeps half of its own scaled Jacobian as the bound. Patches:
/// inner_wall, outer_wall, and one per boundary loop; zones layer_1 (at the lumen) … N. \param
/// directions #V unit vectors, away from the lumen. \param loop_names one per boundary loop.
/// \throws MeshingError if no positive thickness gives positive Jacobians.
ExtrudeResult extrude(const QuadMesh& quads, const std::vector<Vec3>& directions,
                      const std::vector<std::string>& loop_names, const ExtrudeOptions& options);

}  // namespace hexwall
