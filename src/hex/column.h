#pragma once

#include <array>
#include <vector>

#include "quad/quad_mesh.h"

namespace hexwall {

/// A quad of the surface with what is extruded from it: a column of hexes.
struct Column {
  std::array<Vec3, 4> base;       ///< corners, counter-clockwise seen from outside
  std::array<Vec3, 4> direction;  ///< unit vectors
  std::array<double, 4> thickness;
};

/// The column of a quad with the same thickness at its four corners. \param directions one per
/// vertex.
Column column_of(const QuadMesh& quads, int quad, const std::vector<Vec3>& directions,
                 double thickness);

struct ColumnQuality {
  /// Least scaled Jacobian of the column's hexes.
  double scaled_jacobian = 1.0;

  /// How well the faces between layers can be split: for the better diagonal of the worst face,
  /// the least distance of a cell centre from a triangle's plane on its proper side, relative to
  /// half the height of a layer. 1 for flat faces; at or below 0 no diagonal gives tetrahedra of
  /// positive volume towards both cells, which OpenFOAM reports as an error in face tets.
  double face_split = 1.0;
};

/// \param fractions layer boundaries, as of `layer_fractions`.
ColumnQuality column_quality(const Column& column, const std::vector<double>& fractions);

/// Least triple product of the unit edges and the direction at the corners of the base: the scaled
/// Jacobian in the limit of no thickness.
double flat_quality(const Column& column);

/// Heights of the layer boundaries as fractions of the thickness: layers + 1 values from 0 to 1.
std::vector<double> layer_fractions(int layers, double growth);

}  // namespace hexwall
