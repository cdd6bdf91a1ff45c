#include "support/verify_wall.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace hexwall::test {
namespace {

std::vector<Quads> faces_of_patches(const HexMesh& mesh) {
  std::vector<Quads> patches;
  for (const BoundaryPatch& patch : mesh.patches) {
    patches.emplace_back();
    for (const BoundaryFace& face : patch.faces) patches.back().push_back(face.vertices);
  }
  return patches;
}

void expect_layers(const PipelineResult& r) {
  const HexMesh& mesh = r.wall.mesh;
  const std::size_t quads = r.quads.quads.size();
  const std::size_t layers = r.options.layers;
  ASSERT_EQ(mesh.hexes.size(), quads * layers);
  ASSERT_EQ(mesh.quad.size(), mesh.hexes.size());
  ASSERT_EQ(mesh.layer.size(), mesh.hexes.size());
  std::vector<int> uses(mesh.hexes.size(), 0);
  for (std::size_t h = 0; h < mesh.hexes.size(); ++h) {
    ASSERT_TRUE(mesh.quad[h] >= 0 && mesh.layer[h] >= 0);
    ++uses.at(mesh.quad[h] * layers + mesh.layer[h]);
  }
  EXPECT_EQ(std::count(uses.begin(), uses.end(), 1), static_cast<long>(uses.size()));
}

void expect_patches(const PipelineResult& r) {
  const std::vector<BoundaryPatch>& patches = r.wall.mesh.patches;
  ASSERT_EQ(patches.size(), 2 + r.openings.size());
  EXPECT_EQ(patches[0].name, "inner_wall");
  EXPECT_EQ(patches[1].name, "outer_wall");
  EXPECT_EQ(patches[0].faces.size(), r.quads.quads.size());
  EXPECT_EQ(patches[1].faces.size(), r.quads.quads.size());
  for (std::size_t i = 0; i < r.openings.size(); ++i) {
    EXPECT_EQ(patches[i + 2].name, r.openings[i].name);
    EXPECT_FALSE(patches[i + 2].is_wall);
    EXPECT_EQ(std::count(r.quads.loop_of_vertex.begin(), r.quads.loop_of_vertex.end(),
                         static_cast<int>(i)) *
                  r.options.layers,
              static_cast<long>(patches[i + 2].faces.size()));
  }
  for (const BoundaryPatch& patch : patches) {
    for (const BoundaryFace& face : patch.faces) {
      const auto& hex = r.wall.mesh.hexes.at(face.hex);
      for (const int v : face.vertices) {
        ASSERT_NE(std::find(hex.begin(), hex.end(), v), hex.end()) << "a face of " << patch.name;
      }
    }
  }
}

void expect_zones(const HexMesh& mesh, int layers) {
  ASSERT_EQ(static_cast<int>(mesh.zones.size()), layers);
  for (int k = 0; k < layers; ++k) {
    EXPECT_EQ(mesh.zones[k].name, "layer_" + std::to_string(k + 1));
    EXPECT_EQ(static_cast<long>(mesh.zones[k].hexes.size()),
              std::count(mesh.layer.begin(), mesh.layer.end(), k));
    for (const int h : mesh.zones[k].hexes) ASSERT_EQ(mesh.layer.at(h), k);
  }
}

/// The error that rounding leaves in a length, which is greater far from the origin.
double rounding(const HexMesh& mesh, double asked) {
  double greatest = 0.0;
  for (const auto& p : mesh.points) greatest = std::max(greatest, p.cwiseAbs().maxCoeff());
  return 1e-9 * asked + 8.0 * std::numeric_limits<double>::epsilon() * greatest;
}

/// The thickness measured along the columns of hexes is what is reported, and nowhere more than
/// asked for.
void expect_reported_thickness(const PipelineResult& r) {
  const HexMesh& mesh = r.wall.mesh;
  const double asked = *r.options.thickness;
  const double tolerance = rounding(mesh, asked);
  std::vector<double> thickness(r.quads.points.size(), 0.0);
  for (std::size_t h = 0; h < mesh.hexes.size(); ++h) {
    for (int k = 0; k < 4; ++k) {
      // All four hexes at a vertex measure the same edge.
      thickness[r.quads.quads[mesh.quad[h]][k]] +=
          (mesh.points[mesh.hexes[h][k + 4]] - mesh.points[mesh.hexes[h][k]]).norm();
    }
  }
  std::vector<int> quads_at(thickness.size(), 0);
  for (const auto& quad : r.quads.quads) {
    for (const int v : quad) ++quads_at[v];
  }
  for (std::size_t v = 0; v < thickness.size(); ++v) {
    thickness[v] /= quads_at[v];
    ASSERT_NEAR(thickness[v], r.wall.thickness[v], tolerance);
  }
  const double least = *std::min_element(thickness.begin(), thickness.end());
  const double greatest = *std::max_element(thickness.begin(), thickness.end());
  EXPECT_NEAR(r.wall.thickness_min, least, tolerance);
  EXPECT_GT(least, 0.0);
  EXPECT_LE(greatest, asked + tolerance);
  const bool is_told = std::any_of(
      r.warnings.begin(), r.warnings.end(),
      [](const std::string& warning) { return warning.find("thinner") != std::string::npos; });
  EXPECT_EQ(is_told, r.wall.reduced_area_fraction > 0.0);
  EXPECT_EQ(r.wall.reduced_area_fraction > 0.0, least < 0.99 * asked);
}

/// The lower faces of the first layer are the quads, corner by corner.
void expect_quads_at_the_lumen(const PipelineResult& r) {
  const HexMesh& mesh = r.wall.mesh;
  for (std::size_t h = 0; h < mesh.hexes.size(); ++h) {
    if (mesh.layer[h] != 0) continue;
    for (int k = 0; k < 4; ++k) {
      ASSERT_EQ(mesh.points[mesh.hexes[h][k]], r.quads.points[r.quads.quads[mesh.quad[h]][k]]);
    }
  }
}

}  // namespace

HexVerdict verify_wall(const HexMesh& mesh) {
  return verify_hexes(mesh.points, mesh.hexes, faces_of_patches(mesh));
}

void expect_valid_wall(const PipelineResult& r) {
  const HexVerdict verdict = verify_wall(r.wall.mesh);
  EXPECT_TRUE(verdict.faults.none()) << verdict.faults.text();
  EXPECT_NEAR(verdict.hex_volume, verdict.boundary_volume, 1e-9 * verdict.hex_volume);
  EXPECT_NEAR(verdict.min_scaled_jacobian, r.wall.min_scaled_jacobian, 1e-9);
  expect_layers(r);
  expect_patches(r);
  expect_zones(r.wall.mesh, r.options.layers);
  expect_quads_at_the_lumen(r);
  expect_reported_thickness(r);
}

}  // namespace hexwall::test
