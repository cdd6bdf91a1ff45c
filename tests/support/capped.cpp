#include "support/capped.h"

#include "surface/connectivity.h"
#include "surface/loop_shape.h"

namespace hexwall::test {
namespace {

using Triangles = std::vector<std::array<int, 3>>;

void add_wheel(const std::vector<int>& loop, int hub, Triangles& triangles) {
  for (std::size_t i = 0; i < loop.size(); ++i) {
    triangles.push_back({loop[(i + 1) % loop.size()], loop[i], hub});
  }
}

// Ring of vertices between the loop and its centre; returns it.
std::vector<int> add_ring(const std::vector<int>& loop, const Vec3& center,
                          TriangleSurface& surface) {
  std::vector<int> ring;
  for (const int v : loop) {
    ring.push_back(static_cast<int>(surface.points.size()));
    surface.points.push_back(0.5 * (surface.points[v] + center));
  }
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const std::size_t j = (i + 1) % loop.size();
    surface.triangles.push_back({loop[j], loop[i], ring[i]});
    surface.triangles.push_back({loop[j], ring[i], ring[j]});
  }
  return ring;
}

}  // namespace

TriangleSurface capped(const TriangleSurface& surface, CapStyle style) {
  const Connectivity mesh = connectivity_of(surface);
  TriangleSurface result = surface;
  for (std::vector<int> loop : mesh.loops()) {
    if (style == CapStyle::fan) {
      for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
        result.triangles.push_back({loop[i + 1], loop[i], loop[0]});
      }
      continue;
    }
    const Vec3 center = loop_shape(points_of(surface, loop)).center;
    if (style == CapStyle::rings) loop = add_ring(loop, center, result);
    const int hub = static_cast<int>(result.points.size());
    result.points.push_back(center);
    add_wheel(loop, hub, result.triangles);
  }
  return result;
}

}  // namespace hexwall::test
