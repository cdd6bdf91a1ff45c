#include "hex/skin.h"

#include <algorithm>

#include "core/cancel.h"
#include "core/parallel.h"
#include "quad/boundary.h"
#include "surface/self_intersection.h"

namespace hexwall {

Skin::Skin(const QuadMesh& quads, const std::vector<Vec3>& directions, Side side)
    : quads_(quads), directions_(directions), sign_(side == Side::outward ? 1.0 : -1.0) {
  const auto base = static_cast<int>(quads.points.size());
  for (int q = 0; q < static_cast<int>(quads.quads.size()); ++q) {
    const auto& [a, b, c, d] = quads.quads[q];
    faces_.push_back({{a, b, c, d}, q});
    faces_.push_back({{base + a, base + d, base + c, base + b}, q});
  }
  for (const QuadSide& side_of_ring : boundary_sides(quads)) {
    const auto [a, b] = ends_of(quads, side_of_ring);
    faces_.push_back({{b, a, base + a, base + b}, side_of_ring.quad});
  }
}

TriangleSurface Skin::triangulated(const std::vector<double>& thickness, int diagonal) const {
  TriangleSurface surface;
  surface.points.reserve(2 * quads_.points.size());
  for (std::size_t v = 0; v < quads_.points.size(); ++v) {
    surface.points.push_back(quads_.points[v] + sign_ * thickness[v] * directions_[v]);
  }
  surface.points.insert(surface.points.end(), quads_.points.begin(), quads_.points.end());
  surface.triangles.reserve(2 * faces_.size());
  for (const Face& face : faces_) {
    const auto at = [&](int k) { return face.vertices[(k + diagonal) % 4]; };
    surface.triangles.push_back({at(0), at(1), at(2)});
    surface.triangles.push_back({at(0), at(2), at(3)});
  }
  return surface;
}

std::vector<int> Skin::quads_of(const std::vector<std::pair<int, int>>& pairs) const {
  std::vector<int> result;
  for (const auto& [f, g] : pairs) {
    result.insert(result.end(), {faces_[f / 2].quad, faces_[g / 2].quad});
  }
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

std::vector<int> Skin::collisions(const std::vector<double>& thickness) const {
  std::array<std::vector<int>, 2> found;
  parallel_tasks(2, [&](std::size_t diagonal) {
    found[diagonal] =
        quads_of(self_intersections(triangulated(thickness, static_cast<int>(diagonal))));
  });
  return found[0].empty() ? found[1] : found[0];
}

std::vector<int> Skin::collisions(const std::vector<double>& thickness,
                                  const std::vector<int>& among) const {
  std::vector<int> triangles;
  for (int i = 0; i < static_cast<int>(faces_.size()); ++i) {
    if (!std::binary_search(among.begin(), among.end(), faces_[i].quad)) continue;
    triangles.insert(triangles.end(), {2 * i, 2 * i + 1});
  }
  const auto found = [&](int diagonal) {
    throw_if_cancelled();
    return quads_of(self_intersections(triangulated(thickness, diagonal), triangles));
  };
  std::vector<int> quads = found(0);
  return quads.empty() ? found(1) : quads;
}

}  // namespace hexwall
