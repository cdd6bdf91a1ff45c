#pragma once

#include <initializer_list>
#include <string>
#include <vector>

#include "inspect/any_mesh.h"
#include "inspect/mesh_quality.h"

namespace hexwall::test {

/// One element with the points in the order of its corners.
inline AnyMesh single(ElementShape shape, const std::vector<Vec3>& points) {
  AnyMesh mesh;
  mesh.points = points;
  std::vector<int> corners;
  for (int k = 0; k < static_cast<int>(points.size()); ++k) corners.push_back(k);
  mesh.add(shape, corners, 0);
  return mesh;
}

/// nx * ny * nz bricks of the size 1 x 1 x 1 in a row each way, moved by `place`.
template <typename Place>
AnyMesh bricks(int nx, int ny, int nz, const Place& place) {
  AnyMesh mesh;
  const auto at = [&](int i, int j, int k) { return i + (nx + 1) * (j + (ny + 1) * k); };
  for (int k = 0; k <= nz; ++k) {
    for (int j = 0; j <= ny; ++j) {
      for (int i = 0; i <= nx; ++i) mesh.points.push_back(place(Vec3(i, j, k)));
    }
  }
  for (int k = 0; k < nz; ++k) {
    for (int j = 0; j < ny; ++j) {
      for (int i = 0; i < nx; ++i) {
        const std::vector<int> corners{
            at(i, j, k),     at(i + 1, j, k),     at(i + 1, j + 1, k),     at(i, j + 1, k),
            at(i, j, k + 1), at(i + 1, j, k + 1), at(i + 1, j + 1, k + 1), at(i, j + 1, k + 1)};
        mesh.add(ElementShape::hexahedron, corners, mesh.size());
      }
    }
  }
  return mesh;
}

inline const Distribution& metric(const MeshQuality& quality, const std::string& name) {
  for (const MetricResult& result : quality.metrics) {
    if (result.metric.name == name) return result.all;
  }
  throw std::out_of_range(name);
}

inline const FoamMetric& foam(const MeshQuality& quality, const std::string& name) {
  for (const FoamResult& result : quality.foam) {
    if (result.metric.name == name) return result.metric;
  }
  throw std::out_of_range(name);
}

}  // namespace hexwall::test
