#include "support/block_mesh.h"

#include <cmath>
#include <numbers>
#include <string>

namespace hexwall {
namespace {

int point_index(const BlockTube& t, int i, int j, int k) {
  return (k * (t.along + 1) + j) * t.around + i % t.around;
}

std::array<int, 4> quad_at(const BlockTube& t, int i, int j, int k) {
  return {point_index(t, i, j, k), point_index(t, i + 1, j, k), point_index(t, i + 1, j + 1, k),
          point_index(t, i, j + 1, k)};
}

Vec3 position(const BlockTube& t, int i, int j, int k) {
  const double angle = 2 * std::numbers::pi * i / t.around;
  const double radius = t.inner_radius + (t.outer_radius - t.inner_radius) * k / t.layers;
  return {radius * std::cos(angle), radius * std::sin(angle), t.length * j / t.along};
}

void add_points(const BlockTube& t, HexMesh& mesh) {
  for (int k = 0; k <= t.layers; ++k)
    for (int j = 0; j <= t.along; ++j)
      for (int i = 0; i < t.around; ++i) mesh.points.push_back(position(t, i, j, k));
}

void add_boundary_faces(const BlockTube& t, const std::array<int, 8>& h, int j, int k,
                        HexMesh& mesh) {
  const int hex = mesh.cells() - 1;
  if (k == 0) mesh.patches[0].faces.push_back({{h[0], h[3], h[2], h[1]}, hex});
  if (k == t.layers - 1) mesh.patches[1].faces.push_back({{h[4], h[5], h[6], h[7]}, hex});
  if (j == 0) mesh.patches[2].faces.push_back({{h[0], h[1], h[5], h[4]}, hex});
  if (j == t.along - 1) mesh.patches[3].faces.push_back({{h[3], h[7], h[6], h[2]}, hex});
}

void add_hex(const BlockTube& t, int i, int j, int k, HexMesh& mesh) {
  const auto a = quad_at(t, i, j, k);
  const auto b = quad_at(t, i, j, k + 1);
  const int hex = mesh.cells();
  const std::array corners{a[0], a[1], a[2], a[3], b[0], b[1], b[2], b[3]};
  mesh.add(CellShape::hexahedron, corners);
  mesh.layer.push_back(k);
  mesh.quad.push_back(j * t.around + i);
  mesh.zones[k].cells.push_back(hex);
  (k < t.inner_layers ? mesh.regions.front() : mesh.regions.back()).cells.push_back(hex);
  if (k == t.inner_layers - 1) mesh.face_zones[0].faces.push_back({b, hex});
  add_boundary_faces(t, corners, j, k, mesh);
}

}  // namespace

HexMesh block_mesh(const BlockTube& tube) {
  HexMesh mesh;
  mesh.patches = {{"inner_wall", true, {}},
                  {"outer_wall", true, {}},
                  {"loop_0", false, {}},
                  {"loop_1", false, {}}};
  for (int k = 0; k < tube.layers; ++k) mesh.zones.push_back({"layer_" + std::to_string(k), {}});
  if (tube.inner_layers > 0) {
    mesh.regions.push_back({"lumen", {}});
    mesh.face_zones.push_back({"interface", false, {}});
  }
  mesh.regions.push_back({"wall", {}});
  add_points(tube, mesh);
  for (int k = 0; k < tube.layers; ++k)
    for (int j = 0; j < tube.along; ++j)
      for (int i = 0; i < tube.around; ++i) add_hex(tube, i, j, k, mesh);
  return mesh;
}

double volume(const BlockTube& tube) {
  const double sector = std::sin(2 * std::numbers::pi / tube.around) / 2;
  const double inner = tube.inner_radius * tube.inner_radius;
  const double outer = tube.outer_radius * tube.outer_radius;
  return tube.around * sector * (outer - inner) * tube.length;
}

}  // namespace hexwall
