#include "hex/cell_geometry.h"

#include <algorithm>
#include <limits>

#include <Eigen/Geometry>

namespace hexwall {
namespace {

// Faces of a hex whose normals point out, by its corners in VTK's order.
constexpr std::array<std::array<int, 4>, 6> faces_of_hex{
    {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};

}  // namespace

FaceGeometry face_geometry(const Face& face) {
  const Vec3 middle = 0.25 * (face[0] + face[1] + face[2] + face[3]);
  FaceGeometry result{Vec3::Zero(), Vec3::Zero()};
  double weights = 0.0;
  for (int k = 0; k < 4; ++k) {
    const Vec3& a = face[k];
    const Vec3& b = face[(k + 1) % 4];
    const Vec3 doubled_area = (b - a).cross(middle - a);
    const double weight = doubled_area.norm();
    result.area += 0.5 * doubled_area;
    result.center += weight * (a + b + middle) / 3.0;
    weights += weight;
  }
  result.center = weights > 0.0 ? Vec3(result.center / weights) : middle;
  return result;
}

Vec3 cell_center(const std::array<Vec3, 8>& corners) {
  std::array<FaceGeometry, 6> faces;
  Vec3 middle = Vec3::Zero();
  for (int f = 0; f < 6; ++f) {
    const auto& c = faces_of_hex[f];
    faces[f] = face_geometry({corners[c[0]], corners[c[1]], corners[c[2]], corners[c[3]]});
    middle += faces[f].center / 6.0;
  }
  Vec3 sum = Vec3::Zero();
  double volume = 0.0;
  for (const FaceGeometry& face : faces) {
    const double pyramid = face.area.dot(face.center - middle);
    sum += pyramid * (0.75 * face.center + 0.25 * middle);
    volume += pyramid;
  }
  return volume > 0.0 ? Vec3(sum / volume) : middle;
}

double split_height(const Face& face, int k, const Vec3* below, const Vec3* above) {
  double least = std::numeric_limits<double>::max();
  for (const int j : {k + 1, k + 2}) {
    const Vec3& a = face[k];
    const Vec3 normal = (face[j % 4] - a).cross(face[(j + 1) % 4] - a).normalized();
    if (above != nullptr) least = std::min(least, (*above - a).dot(normal));
    if (below != nullptr) least = std::min(least, (a - *below).dot(normal));
  }
  return least;
}

}  // namespace hexwall
