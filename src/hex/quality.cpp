#include "hex/quality.h"

#include <algorithm>

#include <Eigen/Geometry>

#include "core/parallel.h"

namespace hexwall {
namespace {

// The neighbours of each corner in an order of positive orientation.
constexpr std::array<std::array<int, 3>, 8> corner_neighbours{
    {{1, 3, 4}, {2, 0, 5}, {3, 1, 6}, {0, 2, 7}, {7, 5, 0}, {4, 6, 1}, {5, 7, 2}, {6, 4, 3}}};

constexpr std::array<std::array<int, 4>, 6> outward_faces{
    {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};

}  // namespace

double scaled_jacobian(const std::array<Vec3, 8>& p) {
  double least = 1.0;
  for (int k = 0; k < 8; ++k) {
    const auto& [i, j, l] = corner_neighbours[k];
    const Vec3 u = p[i] - p[k];
    const Vec3 v = p[j] - p[k];
    const Vec3 w = p[l] - p[k];
    const double scale = u.norm() * v.norm() * w.norm();
    least = std::min(least, scale > 0.0 ? u.cross(v).dot(w) / scale : 0.0);
  }
  return least;
}

std::array<Vec3, 8> corners_of(const HexMesh& mesh, int hex) {
  std::array<Vec3, 8> corners;
  for (int k = 0; k < 8; ++k) corners[k] = mesh.points[mesh.connectivity[8 * hex + k]];
  return corners;
}

std::vector<double> scaled_jacobians(const HexMesh& mesh) {
  std::vector<double> result(mesh.shape.size());
  parallel_for(result.size(), [&](std::size_t h) {
    result[h] = scaled_jacobian(corners_of(mesh, static_cast<int>(h)));
  });
  return result;
}

double volume(const std::array<Vec3, 8>& p) {
  Vec3 origin = Vec3::Zero();
  for (const Vec3& q : p) origin += q / 8.0;
  double sum = 0.0;
  for (const auto& face : outward_faces) {
    Vec3 center = Vec3::Zero();
    for (const int k : face) center += 0.25 * (p[k] - origin);
    for (int k = 0; k < 4; ++k) {
      const Vec3 a = p[face[k]] - origin;
      const Vec3 b = p[face[(k + 1) % 4]] - origin;
      sum += a.cross(b).dot(center) / 6.0;
    }
  }
  return sum;
}

}  // namespace hexwall
