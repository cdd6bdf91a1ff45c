#include "hex/skin.h"

#include <algorithm>

#include "core/cancel.h"
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
  surface_.points.resize(2 * quads.points.size());
  std::copy(quads.points.begin(), quads.points.end(), surface_.points.begin() + base);
  surface_.triangles.resize(2 * faces_.size());
}

void Skin::move_to(const std::vector<double>& thickness, int diagonal) {
  for (std::size_t v = 0; v < quads_.points.size(); ++v) {
    surface_.points[v] = quads_.points[v] + sign_ * thickness[v] * directions_[v];
  }
  for (std::size_t i = 0; i < faces_.size(); ++i) {
    const auto at = [&](int k) { return faces_[i].vertices[(k + diagonal) % 4]; };
    surface_.triangles[2 * i] = {at(0), at(1), at(2)};
    surface_.triangles[2 * i + 1] = {at(0), at(2), at(3)};
  }
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

std::vector<int> Skin::collisions(const std::vector<double>& thickness, int diagonal) {
  throw_if_cancelled();
  move_to(thickness, diagonal);
  return quads_of(self_intersections(surface_));
}

std::vector<int> Skin::collisions(const std::vector<double>& thickness, int diagonal,
                                  const std::vector<int>& among) {
  throw_if_cancelled();
  move_to(thickness, diagonal);
  std::vector<int> triangles;
  for (int i = 0; i < static_cast<int>(faces_.size()); ++i) {
    if (!std::binary_search(among.begin(), among.end(), faces_[i].quad)) continue;
    triangles.insert(triangles.end(), {2 * i, 2 * i + 1});
  }
  return quads_of(self_intersections(surface_, triangles));
}

}  // namespace hexwall
