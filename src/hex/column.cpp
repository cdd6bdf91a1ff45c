#include "hex/column.h"

#include <algorithm>
#include <limits>

#include <Eigen/Geometry>

#include "hex/cell_geometry.h"
#include "surface/lanes.h"

namespace hexwall {
namespace {

/// The column's corners at each level.
class Levels {
 public:
  explicit Levels(const Column& column)
      : base_(column.base),
        direction_(column.direction),
        outward_(column.outward.data()),
        inward_(column.inward.data()) {}

  const VectorLanes& direction() const { return direction_; }

  VectorLanes at(double level) const {
    return base_ + (level * (level < 0.0 ? inward_ : outward_)) * direction_;
  }

 private:
  VectorLanes base_, direction_;
  Lanes outward_, inward_;
};

// The triple products of what goes from the corners of a face to the next and the previous ones,
// of length 1, and of `up`.
Lanes corner_jacobians(const VectorLanes& face, const VectorLanes& up) {
  const VectorLanes edge = normalized(next(face) - face);
  return dot(cross(previous(edge), edge), up);
}

// Least height of `below` under the triangles of the faces a, b, c, d of each lane, split by the
// better diagonal.
Lanes best_split_heights(const VectorLanes& a, const VectorLanes& b, const VectorLanes& c,
                         const VectorLanes& d, const VectorLanes& below) {
  const auto height = [&](const VectorLanes& p, const VectorLanes& q, const VectorLanes& r) {
    return Lanes(dot(p - below, normalized(cross(q - p, r - p))));
  };
  const Lanes one = height(a, b, c).min(height(a, c, d));
  const Lanes other = height(b, c, d).min(height(b, d, a));
  return one.max(other);
}

}  // namespace

std::vector<ColumnEdge> column_edges(const QuadMesh& quads, const std::vector<Vec3>& directions,
                                     const WallShape& shape) {
  std::vector<ColumnEdge> edges(quads.points.size());
  for (std::size_t v = 0; v < edges.size(); ++v) {
    edges[v] = {quads.points[v], directions[v], shape.outward.empty() ? 0.0 : shape.outward[v],
                shape.inward.empty() ? 0.0 : shape.inward[v]};
  }
  return edges;
}

std::vector<char> changes(const std::vector<ColumnEdge>& last,
                          const std::vector<ColumnEdge>& edges) {
  std::vector<char> changed(edges.size(), 1);
  for (std::size_t v = 0; v < last.size(); ++v) changed[v] = edges[v] == last[v] ? 0 : 1;
  return changed;
}

Column column_of(const QuadMesh& quads, int quad, const std::vector<Vec3>& directions,
                 const WallShape& shape) {
  Column column;
  for (int k = 0; k < 4; ++k) {
    const int v = quads.quads[quad][k];
    column.base[k] = quads.points[v];
    column.direction[k] = directions[v];
    column.outward[k] = shape.outward.empty() ? 0.0 : shape.outward[v];
    column.inward[k] = shape.inward.empty() ? 0.0 : shape.inward[v];
  }
  return column;
}

double scaled_jacobian(const Column& column, const std::vector<double>& levels) {
  const Levels corners(column);
  Lanes least = Lanes::Ones();
  VectorLanes low = corners.at(levels.front());
  for (std::size_t i = 0; i + 1 < levels.size(); ++i) {
    const VectorLanes high = corners.at(levels[i + 1]);
    const VectorLanes up = normalized(high - low);
    least = least.min(corner_jacobians(low, up)).min(corner_jacobians(high, up));
    low = high;
  }
  return least.minCoeff();
}

double face_split(const Column& column, const std::vector<double>& levels) {
  const Levels corners(column);
  double least = 1.0;
  Vec3 center_below = Vec3::Zero();
  VectorLanes low = corners.at(levels.front());
  Vec3 low_center = low.mean();
  for (std::size_t i = 0; i + 1 < levels.size(); ++i) {
    const VectorLanes high = corners.at(levels[i + 1]);
    const Vec3 high_center = high.mean();
    const Vec3 center_above = 0.5 * (low_center + high_center);
    const bool is_inner_skin = i == 0 && levels.front() < 0.0;
    if (is_inner_skin) center_below = 2.0 * low_center - center_above;
    if (i > 0 || is_inner_skin) {
      const double split = best_split_height(low, &center_below, &center_above);
      least = std::min(least, 2.0 * split / (high_center - low_center).norm());
    }
    center_below = center_above;
    low = high;
    low_center = high_center;
  }
  return least;
}

double face_tet_margin(const Column& column, const std::vector<double>& levels) {
  const Levels corners(column);
  double least = std::numeric_limits<double>::max();
  VectorLanes low = corners.at(levels.front());
  Vec3 center_below;
  for (std::size_t i = 0; i + 1 < levels.size(); ++i) {
    const VectorLanes high = corners.at(levels[i + 1]);
    const Vec3 cell = cell_center(low, high);
    double height = best_split_height(low, i > 0 ? &center_below : nullptr, &cell);
    height = std::min(
        height, best_split_heights(low, next(low), next(high), high, VectorLanes(cell)).minCoeff());
    if (i + 2 == levels.size()) {
      height = std::min(height, best_split_height(high, &cell, nullptr));
    }
    const double distance = (high.mean() - low.mean()).norm();
    least = std::min(least, distance > 0.0 ? height / distance : 0.0);
    center_below = cell;
    low = high;
  }
  return least;
}

double corner_deficit(const Column& column, const std::vector<double>& levels, int squarings) {
  const Levels corners(column);
  Lanes sum = Lanes::Zero();
  for (const double level : levels) {
    Lanes deficit = 1.0 - corner_jacobians(corners.at(level), corners.direction());
    for (int i = 0; i < squarings; ++i) deficit *= deficit;
    sum += deficit;
  }
  return sum.sum();
}

double skew(const Column& column) {
  const VectorLanes base(column.base);
  const VectorLanes edge = normalized(next(base) - base);
  return dot(edge, previous(edge)).square().sum();
}

double width_at_skins(const Column& column, const std::vector<double>& levels) {
  const Levels corners(column);
  const VectorLanes base(column.base);
  const VectorLanes edge = next(base) - base;
  double least = 1.0;
  for (const double level : {levels.front(), levels.back()}) {
    const VectorLanes skin = corners.at(level);
    least = std::min(least, (dot(next(skin) - skin, edge) / dot(edge, edge)).minCoeff());
  }
  return least;
}

double flat_quality(const Column& column) {
  return std::min(
      1.0, corner_jacobians(VectorLanes(column.base), VectorLanes(column.direction)).minCoeff());
}

}  // namespace hexwall
