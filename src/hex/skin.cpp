#include "hex/skin.h"

#include <algorithm>

#include "quad/boundary.h"
#include "surface/self_intersection.h"

namespace hexwall {

Skin::Skin(const QuadMesh& quads, const std::vector<Vec3>& directions, Side side)
    : quads_(quads), directions_(directions), sign_(side == Side::outward ? 1.0 : -1.0) {
  const auto add = [&](int quad, int a, int b, int c, int d) {
    surface_.triangles.push_back({a, b, c});
    surface_.triangles.push_back({a, c, d});
    quad_of_.insert(quad_of_.end(), {quad, quad});
  };
  for (std::size_t q = 0; q < quads.quads.size(); ++q) {
    const auto& [a, b, c, d] = quads.quads[q];
    add(static_cast<int>(q), a, b, c, d);
  }
  std::vector<int> base(quads.points.size(), -1);
  for (std::size_t v = 0; v < quads.points.size(); ++v) {
    if (quads.loop_of_vertex[v] < 0) continue;
    base[v] = static_cast<int>(quads.points.size() + loop_vertices_.size());
    loop_vertices_.push_back(static_cast<int>(v));
  }
  for (const QuadSide& side_of_ring : boundary_sides(quads)) {
    const auto [a, b] = ends_of(quads, side_of_ring);
    add(side_of_ring.quad, b, a, base[a], base[b]);
  }
  surface_.points.resize(quads.points.size() + loop_vertices_.size());
}

void Skin::move_to(const std::vector<double>& thickness) {
  for (std::size_t v = 0; v < quads_.points.size(); ++v) {
    surface_.points[v] = quads_.points[v] + sign_ * thickness[v] * directions_[v];
  }
  for (std::size_t i = 0; i < loop_vertices_.size(); ++i) {
    surface_.points[quads_.points.size() + i] = quads_.points[loop_vertices_[i]];
  }
}

std::vector<int> Skin::quads_of(const std::vector<std::pair<int, int>>& pairs) const {
  std::vector<int> result;
  for (const auto& [f, g] : pairs) result.insert(result.end(), {quad_of_[f], quad_of_[g]});
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

std::vector<int> Skin::collisions(const std::vector<double>& thickness) {
  move_to(thickness);
  return quads_of(self_intersections(surface_));
}

std::vector<int> Skin::collisions(const std::vector<double>& thickness,
                                  const std::vector<int>& among) {
  move_to(thickness);
  std::vector<int> triangles;
  for (std::size_t f = 0; f < quad_of_.size(); ++f) {
    if (std::binary_search(among.begin(), among.end(), quad_of_[f])) {
      triangles.push_back(static_cast<int>(f));
    }
  }
  return quads_of(self_intersections(surface_, triangles));
}

}  // namespace hexwall
