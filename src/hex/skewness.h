#pragma once

#include <array>
#include <vector>

#include "hex/column.h"
#include "quad/quality.h"

namespace hexwall {

/// Skewness of the faces of the hexes that columns consist of, as OpenFOAM's checkMesh measures it:
/// how far the line between the centres of the cells on both sides (or, at the boundary, the normal
/// through the cell's centre) passes from the face's centre, relative to the face's extent in that
/// direction. 0 is best; checkMesh reports faces above 4.
class Skewness {
 public:
  /// \param levels of one side, see `LayerPlan`.
  Skewness(const QuadMesh& quads, std::vector<double> levels);

  /// Quads whose column has a face above `limit`. Sorted. What has not changed since the last call
  /// is not computed again. \param columns #V
  std::vector<int> quads_above(double limit, const std::vector<ColumnEdge>& columns);

 private:
  Vec3 point(int v, int level) const { return columns_[v].at(levels_[level]); }
  const Vec3& center(int q, int layer) const { return centers_[q * layers_ + layer]; }
  void find_centers(int q);
  double of_column(int q) const;
  double above_edge(const QuadEdge& edge) const;

  std::vector<std::array<int, 4>> quads_;
  std::vector<double> levels_;
  std::ptrdiff_t layers_;
  std::vector<QuadEdge> edges_;
  std::vector<ColumnEdge> columns_;  // #V at the last call
  std::vector<Vec3> centers_;        // of the cells, column by column
  std::vector<double> of_column_;    // #Q greatest skewness between its layers and of its skins
  std::vector<double> above_edge_;   // #E the same of the faces above an edge
};

}  // namespace hexwall
