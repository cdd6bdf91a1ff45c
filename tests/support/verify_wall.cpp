#include "support/verify_wall.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "surface/self_intersection.h"

namespace hexwall::test {
namespace {

void expect_layers(const PipelineResult& r) {
  const HexMesh& mesh = r.wall;
  const std::size_t quads = r.quads.quads.size();
  const std::size_t layers = r.layers.layers();
  ASSERT_EQ(mesh.shape.size(), quads * layers);
  ASSERT_EQ(mesh.quad.size(), mesh.shape.size());
  ASSERT_EQ(mesh.layer.size(), mesh.shape.size());
  std::vector<int> uses(mesh.shape.size(), 0);
  for (std::size_t h = 0; h < mesh.shape.size(); ++h) {
    ASSERT_TRUE(mesh.quad[h] >= 0 && mesh.layer[h] >= 0);
    ++uses.at(mesh.quad[h] * layers + mesh.layer[h]);
  }
  EXPECT_EQ(std::count(uses.begin(), uses.end(), 1), static_cast<long>(uses.size()));
}

/// The patches of the end rings begin at `first`; there are `layers` layers on their side.
void expect_rings(const PipelineResult& r, std::size_t first, int layers,
                  const std::string& suffix) {
  for (std::size_t i = 0; i < r.openings.size(); ++i) {
    const CellPatch& patch = r.wall.patches.at(first + i);
    EXPECT_EQ(patch.name, r.openings[i].name + suffix);
    EXPECT_FALSE(patch.is_wall);
    EXPECT_EQ(std::count(r.quads.loop_of_vertex.begin(), r.quads.loop_of_vertex.end(),
                         static_cast<int>(i)) *
                  layers,
              static_cast<long>(patch.faces.size()));
  }
}

void expect_patches(const PipelineResult& r) {
  const std::vector<CellPatch>& patches = r.wall.patches;
  const bool both = r.inward && r.outward;
  ASSERT_EQ(patches.size(), 2 + r.openings.size() * (both ? 2 : 1));
  EXPECT_EQ(patches[0].name, r.inward ? "core" : "inner_wall");
  EXPECT_EQ(patches[1].name, r.outward ? "outer_wall" : "wall");
  EXPECT_EQ(patches[0].faces.size(), r.quads.quads.size());
  EXPECT_EQ(patches[1].faces.size(), r.quads.quads.size());
  if (r.inward) expect_rings(r, 2, r.layers.inner, "");
  if (r.outward) {
    expect_rings(r, both ? 2 + r.openings.size() : 2, r.layers.layers() - r.layers.inner,
                 both ? "_wall" : "");
  }
  for (const CellPatch& patch : patches) {
    for (const CellFace& face : patch.faces) {
      const auto hex = r.wall.corners(face.cell);
      for (const int v : face.vertices) {
        ASSERT_NE(std::find(hex.begin(), hex.end(), v), hex.end()) << "a face of " << patch.name;
      }
    }
  }
}

void expect_zones(const PipelineResult& r) {
  const HexMesh& mesh = r.wall;
  std::vector<int> uses(mesh.shape.size(), 0);
  for (std::size_t z = 0; z < mesh.zones.size(); ++z) {
    EXPECT_EQ(mesh.zones[z].name, r.layers.zone_names.at(z));
    EXPECT_FALSE(mesh.zones[z].cells.empty()) << "a layer is missing";
    for (const int h : mesh.zones[z].cells) {
      ++uses.at(h);
      ASSERT_EQ(r.layers.zone.at(mesh.layer.at(h)), static_cast<int>(z));
    }
  }
  EXPECT_EQ(std::count(uses.begin(), uses.end(), 1), static_cast<long>(uses.size()));
}

/// Greatest coordinate: the error that rounding leaves in a length grows with it.
double extent_of(const HexMesh& mesh) {
  double greatest = 0.0;
  for (const auto& p : mesh.points) greatest = std::max(greatest, p.cwiseAbs().maxCoeff());
  return greatest;
}

/// The thickness measured along the columns of hexes is what is reported, and nowhere more than
/// asked for. \param first, last layers of the side.
void expect_reported_thickness(const PipelineResult& r, const ThicknessResult& side, int first,
                               int last, const std::string& name) {
  const HexMesh& mesh = r.wall;
  const auto vertices = static_cast<int>(r.quads.points.size());
  const double rounding =
      8.0 * (last - first) * std::numeric_limits<double>::epsilon() * extent_of(mesh);
  double least_ratio = 1.0;
  for (int v = 0; v < vertices; ++v) {
    double thickness = 0.0;
    for (int layer = first; layer < last; ++layer) {
      thickness +=
          (mesh.points[(layer + 1) * vertices + v] - mesh.points[layer * vertices + v]).norm();
    }
    const double tolerance = 1e-9 * side.asked[v] + rounding;
    ASSERT_NEAR(thickness, side.given[v], tolerance);
    ASSERT_LE(thickness, side.asked[v] + tolerance);
    ASSERT_GT(thickness, 0.0);
    least_ratio = std::min(least_ratio, thickness / side.asked[v]);
  }
  const double least_asked = *std::min_element(side.asked.begin(), side.asked.end());
  EXPECT_NEAR(side.ratio(side.worst_vertex), least_ratio, 1e-9 + rounding / least_asked);
  EXPECT_EQ(side.reduced_area_fraction > 0.0, least_ratio < 0.99);
  const bool is_told =
      std::any_of(r.warnings.begin(), r.warnings.end(), [&](const std::string& warning) {
        return warning.find(name) != std::string::npos &&
               warning.find("thinner") != std::string::npos;
      });
  EXPECT_EQ(is_told, side.reduced_area_fraction > 0.0);
}

/// How exact a hex can be: points are rounded to the last digit of their coordinates, and layers
/// may be thinner than these by many digits.
double rounding_of_layers(const PipelineResult& r) {
  double greatest = 0.0;
  for (const Vec3& p : r.wall.points) greatest = std::max(greatest, p.cwiseAbs().maxCoeff());
  double thinnest = std::numeric_limits<double>::max();
  for (const auto& side : {r.outward, r.inward}) {
    if (!side) continue;
    thinnest = std::min(thinnest, *std::min_element(side->given.begin(), side->given.end()));
  }
  const double layer = thinnest / r.layers.layers();
  return std::min(1e-3, 8.0 * std::numeric_limits<double>::epsilon() * greatest / layer);
}

/// The faces on the surface's level are the quads, corner by corner.
void expect_quads_on_the_surface(const PipelineResult& r) {
  const HexMesh& mesh = r.wall;
  for (int h = 0; h < mesh.cells(); ++h) {
    const bool above = mesh.layer[h] == r.layers.inner;
    const bool below = mesh.layer[h] == r.layers.inner - 1;
    if (!above && !below) continue;
    for (int k = 0; k < 4; ++k) {
      ASSERT_EQ(mesh.points[mesh.corners(h)[above ? k : k + 4]],
                r.quads.points[r.quads.quads[mesh.quad[h]][k]]);
    }
  }
}

}  // namespace

Hexes hexes_of(const HexMesh& mesh) {
  Hexes hexes(mesh.shape.size());
  for (std::size_t h = 0; h < hexes.size(); ++h) {
    std::copy_n(mesh.connectivity.data() + 8 * h, 8, hexes[h].data());
  }
  return hexes;
}

std::vector<Quads> faces_of_patches(const HexMesh& mesh) {
  std::vector<Quads> patches;
  for (const CellPatch& patch : mesh.patches) {
    patches.emplace_back();
    for (const CellFace& face : patch.faces) patches.back().push_back(face.vertices);
  }
  return patches;
}

HexVerdict verify_wall(const HexMesh& mesh) {
  return verify_hexes(mesh.points, hexes_of(mesh), faces_of_patches(mesh));
}

void expect_valid_wall(const PipelineResult& r) {
  const HexVerdict verdict = verify_wall(r.wall);
  EXPECT_TRUE(verdict.faults.none()) << verdict.faults.text();
  const double tolerance = 1e-9 + rounding_of_layers(r);
  EXPECT_NEAR(verdict.hex_volume, verdict.boundary_volume, tolerance * verdict.hex_volume);
  EXPECT_NEAR(verdict.min_scaled_jacobian, r.min_wall_scaled_jacobian, tolerance);
  expect_layers(r);
  expect_patches(r);
  expect_zones(r);
  expect_quads_on_the_surface(r);
  const int layers = r.layers.layers();
  if (r.outward) expect_reported_thickness(r, *r.outward, r.layers.inner, layers, "wall");
  if (r.inward) expect_reported_thickness(r, *r.inward, 0, r.layers.inner, "lumen");
}

/// The whole boundary of the mesh is one closed surface that nowhere meets itself, decided by CGAL
/// on two triangles per face, whichever way the faces are split.
void expect_no_self_intersection(const HexMesh& mesh) {
  for (const int diagonal : {0, 1}) {
    TriangleSurface skin;
    skin.points = mesh.points;
    for (const CellPatch& patch : mesh.patches) {
      for (const CellFace& face : patch.faces) {
        const auto at = [&](int k) { return face.vertices[(k + diagonal) % 4]; };
        skin.triangles.push_back({at(0), at(1), at(2)});
        skin.triangles.push_back({at(0), at(2), at(3)});
      }
    }
    const auto pairs = self_intersections(skin);
    EXPECT_TRUE(pairs.empty()) << pairs.size() << " pairs of triangles meet, the first at "
                               << skin.points[skin.triangles[pairs[0].first][0]].transpose();
  }
}

}  // namespace hexwall::test
