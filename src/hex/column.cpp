#include "hex/column.h"

#include <algorithm>

#include <Eigen/Geometry>

#include "hex/quality.h"

namespace hexwall {
namespace {

using Face = std::array<Vec3, 4>;

Face level_face(const Column& column, double fraction) {
  Face face;
  for (int k = 0; k < 4; ++k) {
    face[k] = column.base[k] + fraction * column.thickness[k] * column.direction[k];
  }
  return face;
}

Vec3 center(const Face& face) {
  return 0.25 * (face[0] + face[1] + face[2] + face[3]);
}

// Least height of `above` over, and of `below` under, the two triangles on either side of the
// diagonal from corner k.
double split_height(const Face& face, int k, const Vec3& below, const Vec3& above) {
  double least = std::numeric_limits<double>::max();
  for (const int j : {k + 1, k + 2}) {
    const Vec3& a = face[k];
    const Vec3 normal = (face[j % 4] - a).cross(face[(j + 1) % 4] - a).normalized();
    least = std::min({least, (above - a).dot(normal), (a - below).dot(normal)});
  }
  return least;
}

}  // namespace

Column column_of(const QuadMesh& quads, int quad, const std::vector<Vec3>& directions,
                 double thickness) {
  Column column;
  for (int k = 0; k < 4; ++k) {
    const int v = quads.quads[quad][k];
    column.base[k] = quads.points[v];
    column.direction[k] = directions[v];
    column.thickness[k] = thickness;
  }
  return column;
}

ColumnQuality column_quality(const Column& column, const std::vector<double>& fractions) {
  ColumnQuality quality;
  Face low = level_face(column, 0.0);
  Vec3 center_below = Vec3::Zero();
  for (std::size_t i = 0; i + 1 < fractions.size(); ++i) {
    const Face high = level_face(column, fractions[i + 1]);
    const Vec3 center_above = 0.5 * (center(low) + center(high));
    const double height = (center(high) - center(low)).norm();
    if (i > 0) {
      const double split = std::max(split_height(low, 0, center_below, center_above),
                                    split_height(low, 1, center_below, center_above));
      quality.face_split = std::min(quality.face_split, split / (0.5 * height));
    }
    quality.scaled_jacobian = std::min(
        quality.scaled_jacobian,
        scaled_jacobian({low[0], low[1], low[2], low[3], high[0], high[1], high[2], high[3]}));
    center_below = center_above;
    low = high;
  }
  return quality;
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

std::vector<double> layer_fractions(int layers, double growth) {
  std::vector<double> fractions{0.0};
  double height = 1.0;
  for (int i = 0; i < layers; ++i, height *= growth) fractions.push_back(fractions.back() + height);
  for (double& f : fractions) f /= fractions.back();
  fractions.back() = 1.0;
  return fractions;
}

}  // namespace hexwall
