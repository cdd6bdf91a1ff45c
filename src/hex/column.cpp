#include "hex/column.h"

#include <algorithm>
#include <limits>

#include <Eigen/Geometry>

#include "hex/cell_geometry.h"
#include "hex/quality.h"

namespace hexwall {
namespace {

Face level_face(const Column& column, double level) {
  Face face;
  for (int k = 0; k < 4; ++k) {
    face[k] =
        point_at(column.base[k], column.direction[k], column.outward[k], column.inward[k], level);
  }
  return face;
}

Vec3 center(const Face& face) {
  return 0.25 * (face[0] + face[1] + face[2] + face[3]);
}

// `split_height` of the better diagonal, towards the cell below the face, the one above it, or
// both.
double best_split_height(const Face& face, const Vec3* below, const Vec3* above) {
  return std::max(split_height(face, 0, below, above), split_height(face, 1, below, above));
}

}  // namespace

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
  double least = 1.0;
  Face low = level_face(column, levels.front());
  for (std::size_t i = 0; i + 1 < levels.size(); ++i) {
    const Face high = level_face(column, levels[i + 1]);
    least = std::min(least, scaled_jacobian({low[0], low[1], low[2], low[3], high[0], high[1],
                                             high[2], high[3]}));
    low = high;
  }
  return least;
}

double face_split(const Column& column, const std::vector<double>& levels) {
  double least = 1.0;
  Vec3 center_below = Vec3::Zero();
  Face low = level_face(column, levels.front());
  Vec3 low_center = center(low);
  for (std::size_t i = 0; i + 1 < levels.size(); ++i) {
    const Face high = level_face(column, levels[i + 1]);
    const Vec3 high_center = center(high);
    const Vec3 center_above = 0.5 * (low_center + high_center);
    if (i > 0) {
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
  double least = std::numeric_limits<double>::max();
  Face low = level_face(column, levels.front());
  Vec3 center_below;
  for (std::size_t i = 0; i + 1 < levels.size(); ++i) {
    const Face high = level_face(column, levels[i + 1]);
    const Vec3 cell =
        cell_center({low[0], low[1], low[2], low[3], high[0], high[1], high[2], high[3]});
    double height = best_split_height(low, i > 0 ? &center_below : nullptr, &cell);
    for (int k = 0; k < 4; ++k) {
      const int j = (k + 1) % 4;
      height =
          std::min(height, best_split_height({low[k], low[j], high[j], high[k]}, &cell, nullptr));
    }
    if (i + 2 == levels.size()) {
      height = std::min(height, best_split_height(high, &cell, nullptr));
    }
    const double distance = (center(high) - center(low)).norm();
    least = std::min(least, distance > 0.0 ? height / distance : 0.0);
    center_below = cell;
    low = high;
  }
  return least;
}

double corner_deficit(const Column& column, const std::vector<double>& levels, int squarings) {
  double sum = 0.0;
  for (const double level : levels) {
    const Face face = level_face(column, level);
    std::array<Vec3, 4> edge;
    for (int k = 0; k < 4; ++k) edge[k] = (face[(k + 1) % 4] - face[k]).normalized();
    for (int k = 0; k < 4; ++k) {
      const double jacobian = edge[(k + 3) % 4].cross(edge[k]).dot(column.direction[k]);
      sum += squared(1.0 - jacobian, squarings);
    }
  }
  return sum;
}

double skew(const Column& column) {
  const auto& p = column.base;
  double sum = 0.0;
  for (int k = 0; k < 4; ++k) {
    const Vec3 u = (p[(k + 1) % 4] - p[k]).normalized();
    sum += squared(u.dot((p[(k + 3) % 4] - p[k]).normalized()), 1);
  }
  return sum;
}

double flat_quality(const Column& column) {
  const auto& p = column.base;
  double least = 1.0;
  for (int k = 0; k < 4; ++k) {
    const Vec3 u = (p[(k + 1) % 4] - p[k]).normalized();
    const Vec3 v = (p[(k + 3) % 4] - p[k]).normalized();
    least = std::min(least, u.cross(v).dot(column.direction[k]));
  }
  return least;
}

}  // namespace hexwall
