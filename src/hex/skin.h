#pragma once

#include <array>
#include <utility>
#include <vector>

#include "hex/thickness.h"

namespace hexwall {

/// The boundary of the layers on one side of a surface, in which collisions are looked for: the
/// skin, the surface itself, and the end rings.
class Skin {
 public:
  Skin(const QuadMesh& quads, const std::vector<Vec3>& directions, Side side);

  /// Quads whose faces meet other faces anywhere but in common vertices and edges, decided with
  /// exact predicates on two triangles per face. Sorted.
  /// \param thickness #V \param diagonal 0 or 1, along which faces are split.
  std::vector<int> collisions(const std::vector<double>& thickness, int diagonal);

  /// The same among the faces of some quads only. \param among sorted.
  std::vector<int> collisions(const std::vector<double>& thickness, int diagonal,
                              const std::vector<int>& among);

 private:
  struct Face {
    std::array<int, 4> vertices;
    int quad;
  };

  void move_to(const std::vector<double>& thickness, int diagonal);
  std::vector<int> quads_of(const std::vector<std::pair<int, int>>& pairs) const;

  const QuadMesh& quads_;
  const std::vector<Vec3>& directions_;
  double sign_;
  std::vector<Face> faces_;
  TriangleSurface surface_;  // vertices of the skin, then of the quad mesh; two triangles a face
};

}  // namespace hexwall
