#pragma once

#include <functional>
#include <span>
#include <vector>

#include "hex/column.h"
#include "quad/quad_mesh.h"
#include "surface/projector.h"

namespace hexwall {

/// Pattern search for better columns: moves a vertex of the quads on the surface, or tilts its
/// direction, as a function of the columns around it tells.
class ColumnSearch {
 public:
  /// \param places #V triangle and position of each vertex of `quads`, kept equal to
  /// `quads.points`. \param directions #V unit vectors. \param shape the wall.
  ColumnSearch(QuadMesh& quads, std::vector<SurfacePoint>& places, std::vector<Vec3>& directions,
               const SurfaceProjector& projector, const WallShape& shape);

  const QuadMesh& quads() const { return quads_; }
  const std::vector<double>& levels() const { return shape_.plan.levels; }
  Column column(int q) const { return column_of(quads_, q, directions_, shape_); }
  std::span<const int> columns_around(int v) const {
    return {quads_of_vertex_.begin() + first_quad_[v],
            quads_of_vertex_.begin() + first_quad_[v + 1]};
  }

  /// Length of the shortest edge at a vertex.
  double shortest_edge(int v) const;

  /// Least `width_at_skins` of the columns around a vertex, as far as it is below `most`.
  double width_around(int v, double most) const;

  /// Turns the rings of steps, so that they do not miss the same ways out again.
  void turn_rings() { turn_ += 2.4; }

  /// Takes the cheapest of a ring of moves and a ring of tilts, `step` times the widest ones, if it
  /// is allowed and cheaper than what there is. \return whether it took one. May run in parallel
  /// for vertices that have no quad in common. \param cost_around of the columns around a vertex as
  /// they are now; where it reaches the limit, its second argument, any value from that on will do.
  /// \param is_allowed whether they may stay as they are now; asked only when they are cheaper.
  bool improve(int v, double step, const std::function<double(int, double)>& cost_around,
               const std::function<bool(int)>& is_allowed);

 private:
  void set(int v, const SurfacePoint& place, const Vec3& direction);

  QuadMesh& quads_;
  std::vector<SurfacePoint>& places_;
  std::vector<Vec3>& directions_;
  const SurfaceProjector& projector_;
  const WallShape& shape_;
  std::vector<int> first_quad_, quads_of_vertex_;
  double turn_ = 0.0;  // of the rings, in radians
};

}  // namespace hexwall
