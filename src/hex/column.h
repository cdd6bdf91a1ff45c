#pragma once

#include <array>
#include <vector>

#include "hex/layers.h"
#include "quad/quad_mesh.h"

namespace hexwall {

/// What is extruded from a quad mesh: layers, and how thick they are together on each side.
struct WallShape {
  LayerPlan plan;
  std::vector<double> outward;  ///< #V thickness; empty without layers on that side
  std::vector<double> inward;   ///< #V thickness; empty without layers on that side
};

/// A quad of the surface with what is extruded from it: a column of hexes.
struct Column {
  std::array<Vec3, 4> base;       ///< corners, counter-clockwise seen from outside
  std::array<Vec3, 4> direction;  ///< unit vectors, outward
  std::array<double, 4> outward;  ///< thickness
  std::array<double, 4> inward;   ///< thickness
};

/// A point of the edge of a column at a level.
inline Vec3 point_at(const Vec3& base, const Vec3& direction, double outward, double inward,
                     double level) {
  return base + level * (level < 0.0 ? inward : outward) * direction;
}

/// The edge of the columns at a vertex.
struct ColumnEdge {
  Vec3 base;
  Vec3 direction;
  double outward = 0.0;  ///< thickness
  double inward = 0.0;   ///< thickness
  bool operator==(const ColumnEdge&) const = default;

  Vec3 at(double level) const { return point_at(base, direction, outward, inward, level); }
};

/// #V. \param directions #V.
std::vector<ColumnEdge> column_edges(const QuadMesh& quads, const std::vector<Vec3>& directions,
                                     const WallShape& shape);

/// #V 1 where an edge is not what it was; everywhere if `last` is empty.
std::vector<char> changes(const std::vector<ColumnEdge>& last,
                          const std::vector<ColumnEdge>& edges);

/// The column of a quad. \param directions #V.
Column column_of(const QuadMesh& quads, int quad, const std::vector<Vec3>& directions,
                 const WallShape& shape);

/// Least scaled Jacobian of the column's hexes.
/// \param levels of the layer boundaries, rising, see `LayerPlan`.
double scaled_jacobian(const Column& column, const std::vector<double>& levels);

/// How well the faces between layers can be split, and the inner skin, as if there were one more
/// layer beyond it, for the sake of cells in the lumen: for the better diagonal of the worst face,
/// the least distance of a cell centre from a triangle's plane on its proper side, relative to half
/// the height of a layer. 1 for flat faces; at or below 0 no diagonal gives tetrahedra of positive
/// volume towards both cells, which OpenFOAM reports as an error in face tets.
double face_split(const Column& column, const std::vector<double>& levels);

/// By how much the faces of the column's hexes can be split into triangles which, with the centres
/// of the cells, give tetrahedra of positive volume, as OpenFOAM requires (the check of face tets):
/// those between layers towards both cells, the others towards the column's cell. The least
/// distance of a centre from a triangle's plane over the layer's height; at or below 0 OpenFOAM
/// reports an error.
double face_tet_margin(const Column& column, const std::vector<double>& levels);

inline bool has_face_tets(const Column& column, const std::vector<double>& levels) {
  return face_tet_margin(column, levels) > 0.0;
}

/// Sum of (1 - J)^(2^squarings) over the corners of the base carried to each level, J the triple
/// product of the unit edges and the direction there, of which the least is the column's scaled
/// Jacobian. A smooth measure of how bad the worst are.
double corner_deficit(const Column& column, const std::vector<double>& levels, int squarings);

/// x^(2^squarings).
inline double squared(double x, int squarings) {
  for (int i = 0; i < squarings; ++i) x *= x;
  return x;
}

/// Least share of an edge of the base that is left of it at the skins, along that edge: 1 in a
/// straight column, 0 where it closes up, which its scaled Jacobian does not tell.
double width_at_skins(const Column& column, const std::vector<double>& levels);

/// Sum of the squared cosines of the corner angles of the base.
double skew(const Column& column);

/// Least triple product of the unit edges and the direction at the corners of the base: the scaled
/// Jacobian in the limit of no thickness.
double flat_quality(const Column& column);

}  // namespace hexwall
