#pragma once

#include <vector>

#include "hex/thickness.h"

namespace hexwall {

/// The skin of one side of a wall with its end rings, in which collisions are looked for.
class Skin {
 public:
  Skin(const QuadMesh& quads, const std::vector<Vec3>& directions, Side side);

  /// Quads whose piece of the skin, or of an end ring, meets another piece anywhere but in common
  /// vertices and edges, decided with exact predicates on two triangles per face. Sorted.
  /// \param thickness #V
  std::vector<int> collisions(const std::vector<double>& thickness);

  /// The same among the given quads only. \param quads sorted.
  std::vector<int> collisions(const std::vector<double>& thickness, const std::vector<int>& among);

 private:
  void move_to(const std::vector<double>& thickness);
  std::vector<int> quads_of(const std::vector<std::pair<int, int>>& pairs) const;

  const QuadMesh& quads_;
  const std::vector<Vec3>& directions_;
  double sign_;
  TriangleSurface surface_;         // the skin's vertices, then those of the loops
  std::vector<int> quad_of_;        // #F of surface_
  std::vector<int> loop_vertices_;  // of the quad mesh, behind the skin's
};

}  // namespace hexwall
