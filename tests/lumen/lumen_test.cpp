#include "lumen/lumen.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <numbers>
#include <set>
#include <sstream>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/errors.h"
#include "exporters/gmsh.h"
#include "exporters/openfoam.h"
#include "exporters/vtk_files.h"
#include "lumen/core_surface.h"
#include "support/block_mesh.h"
#include "support/check_mesh.h"
#include "support/child_process.h"
#include "support/temporary_folder.h"
#include "surface/generate.h"

namespace hexwall {
namespace {

PipelineResult tube_layers(bool with_wall = false) {
  PipelineOptions options;
  options.size = 0.35;
  if (!with_wall) options.outward.reset();
  options.inward = LayerOptions{};
  options.leaves_room_for_core = true;
  return run_pipeline(cylinder(1.0, 4.0, 40, 30), options);
}

const PipelineResult& tube() {
  static const PipelineResult result = tube_layers();
  return result;
}

LumenResult mesh_of(const PipelineResult& layers, LumenOptions::Mesh kind) {
  LumenOptions options;
  options.mesh = kind;
  return make_lumen(layers, options);
}

/// Volume of a polyhedron by the divergence theorem, faces split around the mean of their corners.
double flux(const std::vector<Vec3>& points, const std::array<int, 4>& face) {
  const int n = face[3] < 0 ? 3 : 4;
  Vec3 middle = Vec3::Zero();
  for (int k = 0; k < n; ++k) middle += points[face[k]] / n;
  double sum = 0.0;
  for (int k = 0; k < n; ++k) {
    sum += middle.cross(points[face[k]]).dot(points[face[(k + 1) % n]]) / 6.0;
  }
  return sum;
}

// The faces of shapes, written down once more and in another way than in the library.
std::vector<std::array<int, 4>> faces(CellShape shape, std::span<const int> c) {
  if (shape == CellShape::tetrahedron) {
    return {{c[0], c[2], c[1], -1},
            {c[0], c[1], c[3], -1},
            {c[0], c[3], c[2], -1},
            {c[1], c[2], c[3], -1}};
  }
  if (shape == CellShape::pyramid) {
    return {{c[3], c[2], c[1], c[0]},
            {c[4], c[0], c[1], -1},
            {c[4], c[1], c[2], -1},
            {c[4], c[2], c[3], -1},
            {c[4], c[3], c[0], -1}};
  }
  return {{c[3], c[2], c[1], c[0]}, {c[4], c[5], c[6], c[7]}, {c[0], c[1], c[5], c[4]},
          {c[1], c[2], c[6], c[5]}, {c[2], c[3], c[7], c[6]}, {c[3], c[0], c[4], c[7]}};
}

std::array<int, 4> key_of(std::array<int, 4> face) {
  std::sort(face.begin(), face.end());
  return face;
}

// Each cell has volume, each face one or two cells, those of one cell are the patches', and the
// cells fill what the patches bound.
void expect_valid(const CellMesh& mesh) {
  std::map<std::array<int, 4>, int> uses;
  double volume = 0.0;
  for (int c = 0; c < mesh.cells(); ++c) {
    double of_cell = 0.0;
    for (const auto& face : faces(mesh.shape[c], mesh.corners(c))) {
      of_cell += flux(mesh.points, face);
      ++uses[key_of(face)];
    }
    EXPECT_GT(of_cell, 0.0) << "cell " << c;
    volume += of_cell;
  }
  double bounded = 0.0;
  std::set<std::array<int, 4>> on_boundary;
  for (const CellPatch& patch : mesh.patches) {
    EXPECT_FALSE(patch.faces.empty()) << patch.name;
    for (const CellFace& face : patch.faces) {
      bounded += flux(mesh.points, face.vertices);
      EXPECT_TRUE(on_boundary.insert(key_of(face.vertices)).second);
    }
  }
  EXPECT_NEAR(volume, bounded, 1e-10 * volume);
  for (const auto& [key, count] : uses) {
    EXPECT_EQ(count, on_boundary.count(key) > 0 ? 1 : 2);
  }
  EXPECT_EQ(uses.size(), shared_faces(mesh).faces.size());
}

std::vector<std::string> patch_names(const CellMesh& mesh) {
  std::vector<std::string> names;
  for (const CellPatch& patch : mesh.patches) names.push_back(patch.name);
  return names;
}

TEST(HybridLumen, IsOneConformingMeshThatFillsItsBoundary) {
  const LumenResult lumen = mesh_of(tube(), LumenOptions::Mesh::hybrid);
  expect_valid(lumen.mesh);
  const auto quads = static_cast<int>(tube().quads.quads.size());
  EXPECT_EQ(lumen.counts.hexes, 3 * quads);
  EXPECT_EQ(lumen.counts.pyramids, quads);
  EXPECT_EQ(lumen.counts.hexes + lumen.counts.pyramids + lumen.counts.tets, lumen.mesh.cells());
  EXPECT_EQ(patch_names(lumen.mesh), (std::vector<std::string>{"wall", "loop_0", "loop_1"}));
  EXPECT_EQ(lumen.mesh.patches[0].faces.size(), static_cast<std::size_t>(quads));
  EXPECT_EQ(lumen.mesh.zones.back().name, "lumen_core");
}

TEST(HybridLumen, StaysBelowTheLimitsOfOpenFoam) {
  const LumenResult lumen = mesh_of(tube(), LumenOptions::Mesh::hybrid);
  ASSERT_EQ(lumen.quality.size(), 1U);
  EXPECT_LT(lumen.quality[0].non_orthogonality.value, 70.0);
  EXPECT_LT(lumen.quality[0].skewness.value, 4.0);
  EXPECT_GT(lumen.quality[0].least_volume, 0.0);
}

// The end faces are polygons in their planes: rings and caps together.
TEST(HybridLumen, MeasuresItsOpeningsAndTakesTheLargestAsInlet) {
  const LumenResult lumen = mesh_of(tube(), LumenOptions::Mesh::hybrid);
  ASSERT_EQ(lumen.openings.size(), 2U);
  EXPECT_EQ(std::count_if(lumen.openings.begin(), lumen.openings.end(),
                          [](const LumenOpening& o) { return o.inlet; }),
            1);
  for (const LumenOpening& o : lumen.openings) {
    EXPECT_NEAR(o.area, std::numbers::pi, 0.1);
    EXPECT_NEAR(o.radius, 1.0, 0.02);
    EXPECT_NEAR(o.normal.z(), o.center.z() > 2.0 ? 1.0 : -1.0, 1e-9);
  }
}

TEST(HybridLumen, AnyOpeningCanBeTheInletButNoOther) {
  LumenOptions options;
  options.inlet = "loop_1";
  EXPECT_TRUE(make_lumen(tube(), options).openings[1].inlet);
  options.inlet = "aorta";
  EXPECT_THROW(make_lumen(tube(), options), UsageError);
}

TEST(HybridLumen, IsTheSameEveryTime) {
  const LumenResult a = mesh_of(tube(), LumenOptions::Mesh::hybrid);
  const LumenResult b = mesh_of(tube_layers(), LumenOptions::Mesh::hybrid);
  EXPECT_EQ(a.mesh.points, b.mesh.points);
  EXPECT_EQ(a.mesh.connectivity, b.mesh.connectivity);
}

TEST(TetLumen, HasTheSplitQuadsOfTheWall) {
  const LumenResult lumen = mesh_of(tube(), LumenOptions::Mesh::tet);
  expect_valid(lumen.mesh);
  EXPECT_EQ(lumen.counts.tets, lumen.mesh.cells());
  const CellPatch& wall = lumen.mesh.patches.front();
  EXPECT_EQ(wall.name, "wall");
  std::set<int> of_quads;
  for (const CellFace& face : wall.faces) {
    EXPECT_EQ(face.size(), 3);
    const bool is_within_a_quad = std::any_of(
        tube().quads.quads.begin(), tube().quads.quads.end(), [&](const std::array<int, 4>& quad) {
          return std::all_of(face.vertices.begin(), face.vertices.begin() + 3, [&](int v) {
            return std::find(quad.begin(), quad.end(), v) != quad.end();
          });
        });
    EXPECT_TRUE(is_within_a_quad);
  }
  EXPECT_EQ(wall.faces.size(), 2 * tube().quads.quads.size());
}

TEST(LumenAndWall, AreTwoClosedRegionsWithOneInterface) {
  const LumenResult both = mesh_of(tube_layers(true), LumenOptions::Mesh::hybrid);
  expect_valid(both.mesh);
  ASSERT_EQ(both.mesh.regions.size(), 2U);
  const CellMesh lumen = region_mesh(both.mesh, 0);
  const CellMesh wall = region_mesh(both.mesh, 1);
  expect_valid(lumen);
  expect_valid(wall);
  const CellPatch& inside = lumen.patches.back();
  const CellPatch& outside = wall.patches.back();
  EXPECT_EQ(inside.name, "lumen_to_wall");
  EXPECT_EQ(outside.name, "wall_to_lumen");
  ASSERT_EQ(inside.faces.size(), outside.faces.size());
  for (std::size_t i = 0; i < inside.faces.size(); ++i) {
    EXPECT_NEAR(flux(lumen.points, inside.faces[i].vertices),
                -flux(wall.points, outside.faces[i].vertices), 1e-12);
  }
  const TemporaryFolder folder;
  write_openfoam_regions(folder.path(), both.mesh, 1e-3);
  const std::string boundary = bytes_of(folder / "constant/lumen/polyMesh/boundary");
  EXPECT_NE(boundary.find("samplePatch     wall_to_lumen"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(folder / "constant/wall/polyMesh/owner"));
  EXPECT_THROW(write_openfoam_regions(folder.path(), lumen, 1e-3), Error);
}

/// The number behind `words` in a text.
double number_after(const std::string& text, const std::string& words) {
  const std::size_t found = text.find(words);
  EXPECT_NE(found, std::string::npos) << words << " in\n" << text;
  return found == std::string::npos ? 0.0 : std::stod(text.substr(found + words.size()));
}

void expect_agreement(const LumenResult& lumen, bool is_ok) {
  const TemporaryFolder folder;
  write_openfoam(folder.path(), lumen.mesh, 1e-3);
  const CheckMeshResult check = check_mesh(folder.path());
  if (!check.available) GTEST_SKIP() << "checkMesh is not installed";
  const CellQuality& q = lumen.quality[0];
  EXPECT_NEAR(number_after(check.log, "non-orthogonality Max: "), q.non_orthogonality.value, 1e-3);
  EXPECT_NEAR(number_after(check.log, "average: "), q.mean_non_orthogonality, 1e-3);
  EXPECT_NEAR(number_after(check.log, "Max skewness = "), q.skewness.value, 1e-4);
  EXPECT_NEAR(number_after(check.log, "Max aspect ratio = "), q.aspect_ratio.value, 1e-3);
  EXPECT_NEAR(number_after(check.log, "Total volume = ") * 1e9, q.volume, 1e-4 * q.volume);
  if (is_ok) {
    EXPECT_TRUE(check.ok) << check.log;
  }
}

TEST(CellQualityOfLumen, IsWhatCheckMeshMeasures) {
  expect_agreement(mesh_of(tube(), LumenOptions::Mesh::hybrid), true);
}

TEST(CellQualityOfTetrahedra, IsWhatCheckMeshMeasures) {
  expect_agreement(mesh_of(tube(), LumenOptions::Mesh::tet), false);
}

TEST(LumenFiles, GmshReadsAllShapes) {
  const TemporaryFolder folder;
  const LumenResult lumen = mesh_of(tube(), LumenOptions::Mesh::hybrid);
  const std::string file = (folder / "lumen.msh").string();
  write_gmsh(file, lumen.mesh);
  const test::ChildResult run = test::run_child({"gmsh", file, "-check"});
  if (run.exit_code != 0 && run.out.empty()) GTEST_SKIP() << "gmsh is not installed";
  EXPECT_EQ((run.out + run.err).find("Error"), std::string::npos) << run.out << run.err;
  EXPECT_EQ((run.out + run.err).find("Warning"), std::string::npos) << run.out << run.err;
}

// The openings of a plane with a hole have nothing between them.
TEST(LumenOfAPlane, IsRefused) {
  PipelineOptions options;
  options.size = 0.3;
  options.outward.reset();
  options.inward = LayerOptions{};
  options.leaves_room_for_core = true;
  const PipelineResult layers = run_pipeline(annulus(1.0, 2.0, 40, 5), options);
  EXPECT_THROW(mesh_of(layers, LumenOptions::Mesh::hybrid), Error);
  EXPECT_THROW(mesh_of(layers, LumenOptions::Mesh::tet), Error);
}

TEST(CellFaces, OfAllShapesPointOut) {
  CellMesh wedge;
  wedge.points = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}, {0, 1, 1}, {1, 0, 1}};
  wedge.add(CellShape::wedge, std::array{0, 1, 2, 3, 4, 5});
  double volume = 0.0;
  for (int i = 0; i < 5; ++i) volume += flux(wedge.points, cell_face(wedge, 0, i));
  EXPECT_NEAR(volume, 0.5, 1e-15);
}

}  // namespace
}  // namespace hexwall
