#pragma once

#include <array>
#include <vector>

#include "hex/column.h"
#include "hex/thickness.h"
#include "surface/triangle_surface.h"

namespace hexwall {

/// The boundary of the layers on one side of a surface, in which collisions are looked for: the
/// skin, the surface itself, and the end rings.
class Skin {
 public:
  Skin(const QuadMesh& quads, Side side);

  /// Quads whose faces meet other faces anywhere but in common vertices and edges, however faces
  /// are split into two triangles: decided like `self_intersections` for either way, and for the
  /// second one only where the first finds nothing. Sorted. What has not moved since the last call
  /// and did not meet then is not looked at again. \param columns #V \param clearance factor on
  /// their thickness.
  std::vector<int> collisions(const std::vector<ColumnEdge>& columns, double clearance);

  /// The same among the faces of some quads only. \param among sorted.
  std::vector<int> collisions(const std::vector<ColumnEdge>& columns, double clearance,
                              const std::vector<int>& among) const;

 private:
  struct Face {
    std::array<int, 4> vertices;
    int quad;
  };

  // Of the skin, then of the quad mesh.
  std::vector<Vec3> points(const std::vector<ColumnEdge>& columns, double clearance) const;
  // Of some faces those that may meet others, or are folded, if they or the others are active; the
  // rest certainly don't.
  std::vector<int> in_doubt(const std::vector<Vec3>& points, const std::vector<int>& faces,
                            const std::vector<char>& is_active) const;
  // Quads of doubtful faces that meet.
  std::vector<int> collisions_of(const std::vector<Vec3>& points,
                                 const std::vector<int>& doubtful) const;
  // Faces with a vertex that is not where it was at the last call, or in doubt since then.
  std::vector<char> active_faces(const std::vector<Vec3>& points) const;

  double level_;  // of the skin
  std::vector<Face> faces_;
  std::vector<Vec3> last_points_;   // of the last search over all faces
  std::vector<int> last_doubtful_;  // if faces met then
};

}  // namespace hexwall
