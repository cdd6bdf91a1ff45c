#include "hex/column_quality.h"

#include <algorithm>
#include <utility>

#include "core/parallel.h"

namespace hexwall {
namespace {

// Faces that are split worse than this are so because the quads are warped by more than the layers
// are high: only smaller quads or higher layers mend that.
constexpr double hopeless_face_split = -4.0;
// Beyond this share of columns with faces that cannot be split, no polishing of a few mends them.
constexpr double most_badly_split = 0.02;

}  // namespace

std::span<const ColumnQuality> ColumnQualities::of(const QuadMesh& quads,
                                                   const std::vector<Vec3>& directions,
                                                   const WallShape& shape) {
  std::vector<ColumnEdge> edges = column_edges(quads, directions, shape);
  const std::vector<char> changed = changes(edges_, edges);
  edges_ = std::move(edges);
  qualities_.resize(quads.quads.size());
  parallel_for(qualities_.size(), [&](std::size_t q) {
    const auto& quad = quads.quads[q];
    if (std::none_of(quad.begin(), quad.end(), [&](int v) { return changed[v] != 0; })) return;
    const Column column = column_of(quads, static_cast<int>(q), directions, shape);
    const std::vector<double>& levels = shape.plan.levels;
    qualities_[q] = {scaled_jacobian(column, levels), face_split(column, levels),
                     face_tet_margin(column, levels)};
  });
  return qualities_;
}

double least_scaled_jacobian(std::span<const ColumnQuality> columns) {
  double least = 1.0;
  for (const ColumnQuality& column : columns) least = std::min(least, column.scaled_jacobian);
  return least;
}

std::vector<char> hopeless_columns(std::span<const ColumnQuality> columns) {
  std::vector<char> is_hopeless;
  is_hopeless.reserve(columns.size());
  double badly_split = 0.0;
  for (const ColumnQuality& column : columns) {
    is_hopeless.push_back(column.face_split < hopeless_face_split ? 1 : 0);
    if (column.face_split < 0.0) badly_split += 1.0;
  }
  if (badly_split > most_badly_split * static_cast<double>(columns.size())) {
    std::fill(is_hopeless.begin(), is_hopeless.end(), 1);
  }
  return is_hopeless;
}

}  // namespace hexwall
