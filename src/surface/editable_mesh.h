#pragma once

#include <array>
#include <vector>

#include "surface/connectivity.h"
#include "surface/triangle_surface.h"

namespace hexwall {

/// A triangle mesh on a surface that can be refined without changing the surface's shape. Half-edge
/// `h = 3 f + k` as in `Connectivity`; numbers of vertices stay, new ones follow.
class EditableMesh {
 public:
  /// \param mesh of `surface`.
  EditableMesh(const TriangleSurface& surface, const Connectivity& mesh);

  static int next(int h) { return Connectivity::next(h); }
  static int prev(int h) { return Connectivity::prev(h); }
  int halfedge_count() const { return static_cast<int>(twin_.size()); }
  int tail(int h) const { return surface_.triangles[h / 3][h % 3]; }
  int tip(int h) const { return tail(next(h)); }
  int apex(int h) const { return tail(prev(h)); }
  int twin(int h) const { return twin_[h]; }  ///< -1 on the boundary
  const Vec3& point(int v) const { return surface_.points[v]; }
  double length(int h) const { return (point(tip(h)) - point(tail(h))).norm(); }

  const TriangleSurface& surface() const { return surface_; }
  /// Triangle of the original surface in which each triangle lies. #F.
  const std::vector<int>& parent() const { return parent_; }

  /// Puts a vertex at (1 - t) tail + t tip of an edge and joins it to the corners opposite.
  /// Half-edge `h` then ends at the new vertex. The faces next to it are `faces_at_last_split`.
  /// \pre twin(h) >= 0. \returns the new vertex.
  int split(int h, double t);
  const std::array<int, 4>& faces_at_last_split() const { return split_faces_; }

  /// Puts a vertex inside triangle `f` and joins it to the three corners. \returns the new vertex.
  int insert(int f, const Vec3& position);

  /// Replaces the diagonal `h` of its two faces by the other one.
  /// \pre twin(h) >= 0, and both faces lie in one plane or the change of shape is wanted.
  void flip(int h);

  /// Makes boundary edges of both sides of `h`.
  void detach(int h);

  TriangleSurface take_surface() { return std::move(surface_); }
  std::vector<int> take_parent() { return std::move(parent_); }

 private:
  void link(int g, int h);
  int split_one_side(int h, int p);

  TriangleSurface surface_;
  std::vector<int> parent_, twin_;
  std::array<int, 4> split_faces_{};
};

}  // namespace hexwall
