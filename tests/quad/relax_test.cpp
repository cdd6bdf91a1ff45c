// Relaxation of quads, by itself.

#include "quad/relax.h"

#include <algorithm>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "quad/quality.h"

namespace hexwall {
namespace {

// One step in a plane.
QuadMesh relaxed(QuadMesh mesh, const std::vector<QuadSize>& sizes) {
  const TriangleSurface surface{{{-9, -9, 0}, {20, -9, 0}, {20, 9, 0}, {-9, 9, 0}},
                                {{0, 1, 2}, {0, 2, 3}}};
  std::vector<int> face(mesh.points.size(), 0);
  mesh.loop_of_vertex.assign(mesh.points.size(), -1);
  const RelaxResult result =
      relax(mesh, face, sizes, surface, Connectivity(4, surface.triangles), 1);
  EXPECT_EQ(result.iterations, 1);
  return mesh;
}

double least_corner(const QuadMesh& mesh, int q) {
  const auto corners = corners_of(mesh, q);
  double least = 1.0;
  for (int k = 0; k < 4; ++k) {
    const Vec3 next = corners[(k + 1) % 4] - corners[k];
    const Vec3 last = corners[(k + 3) % 4] - corners[k];
    least = std::min(least, next.cross(last).z() / (next.norm() * last.norm()));
  }
  return least;
}

// In a row of three the outer ones want to be far wider than the middle one leaves room for.
TEST(Relax, TurnsNoQuadOver) {
  QuadMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0},
                 {0, 1, 0}, {1, 1, 0}, {2, 1, 0}, {3, 1, 0}};
  mesh.quads = {{0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}};
  mesh = relaxed(mesh, {{50.0, 1.0}, {1.0, 1.0}, {50.0, 1.0}});
  for (int q = 0; q < 3; ++q) EXPECT_GT(least_corner(mesh, q), 0.0) << q;
}

// Its outer ones are too wide, it overlaps them.
TEST(Relax, TurnsAQuadRight) {
  QuadMesh mesh;
  mesh.points = {{0, 0, 0}, {1.8, 0, 0}, {1.2, 0, 0}, {3, 0, 0},
                 {0, 1, 0}, {1.8, 1, 0}, {1.2, 1, 0}, {3, 1, 0}};
  mesh.quads = {{0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}};
  ASSERT_LT(least_corner(mesh, 1), 0.0);
  mesh = relaxed(mesh, {{0.5, 1.0}, {0.05, 1.0}, {0.5, 1.0}});
  for (int q = 0; q < 3; ++q) EXPECT_GT(least_corner(mesh, q), 0.0) << q;
}

// Two quads below the lower corners of a third one want to push them past each other; a fourth one
// is inverted from the start.
TEST(Relax, FoldsNothingWhereAnotherQuadIsInverted) {
  QuadMesh mesh;
  mesh.points = {{0, -1, 0}, {1, -1, 0}, {1, 0, 0}, {0, 0, 0},    {2, -1, 0},
                 {3, -1, 0}, {3, 0, 0},  {2, 0, 0}, {2, 1, 0},    {1, 1, 0},
                 {6, 0, 0},  {7, 0, 0},  {7, 1, 0}, {6.7, 0.2, 0}};
  mesh.quads = {{0, 1, 2, 3}, {4, 5, 6, 7}, {2, 7, 8, 9}, {10, 11, 12, 13}};
  const double before = least_corner(mesh, 3);
  ASSERT_LT(before, 0.0);
  mesh = relaxed(mesh, {{20.0, 1.0}, {20.0, 1.0}, {1.0, 1.0}, {1.0, 1.0}});
  for (int q = 0; q < 3; ++q) EXPECT_GT(least_corner(mesh, q), 0.0) << q;
  EXPECT_GT(least_corner(mesh, 3), before);
}

}  // namespace
}  // namespace hexwall
