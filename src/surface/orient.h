#pragma once

#include <string>
#include <utility>

#include "core/errors.h"
#include "surface/connectivity.h"
#include "surface/triangle_surface.h"

namespace hexwall {

/// Refusal of a surface that contains a Moebius band.
class NotOrientable : public TopologyError {
 public:
  NotOrientable(const std::string& message, Vec3 place)
      : TopologyError(message), place_(std::move(place)) {}
  /// A place on the band, of the many where a cut would open it.
  const Vec3& place() const { return place_; }

 private:
  Vec3 place_;
};

struct OrientResult {
  TriangleSurface surface;
  int flipped = 0;  ///< triangles whose winding is not that of the input
};

/// Gives all triangles that are connected over edges the same winding, that of the majority.
/// \pre no edge has more than two triangles.
/// \throws NotOrientable if that is impossible (Möbius band).
OrientResult make_consistent(const TriangleSurface& surface);

/// Volume enclosed once every boundary loop is closed by a fan of triangles to its centroid:
/// positive if the triangles are counter-clockwise seen from outside.
/// \pre consistent winding. \param mesh of `surface`.
double signed_volume(const TriangleSurface& surface, const Connectivity& mesh);

/// The same. \throws TopologyError if the mesh is not manifold.
double signed_volume(const TriangleSurface& surface);

/// Makes the winding consistent and counter-clockwise seen from outside (`signed_volume` > 0). A
/// flat surface has no outside: it keeps the winding of the majority of its triangles.
/// \pre one connected component, no edge with more than two triangles.
/// \throws TopologyError if the surface is not orientable or not manifold at a vertex.
OrientResult orient(const TriangleSurface& surface);

/// The same of a surface that `make_consistent` gave, and of its connectivity.
void wind_outward(OrientResult& consistent, Connectivity& mesh);

}  // namespace hexwall
