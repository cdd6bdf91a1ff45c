// Costs of cells near the limits of checkMesh.

#include "lumen/cell_cost.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

namespace hexwall::test {
namespace {

/// A box of 1 x 1 x `height`.
double cost_of_box(double height) {
  std::array<Vec3, 6> areas;
  for (int i = 0; i < 6; ++i) areas[i] = Vec3::Unit(i / 2) * (i / 2 == 2 ? 1.0 : height);
  return cost::of_cell(areas);
}

// checkMesh's determinant of the box, relative to that of a cube.
double determinant_of_box(double height) {
  return std::pow(height, 4) / std::pow((4.0 * height + 2.0) / 6.0, 6);
}

TEST(CellCost, RisesSteeplyWhereCheckMeshFindsTheDeterminantSmall) {
  EXPECT_LT(cost_of_box(1.0), 1e-5);
  const double above = 0.041;
  ASSERT_GT(determinant_of_box(above), 1.2e-3);
  const double below = 0.0345;
  ASSERT_LT(determinant_of_box(below), 1e-3);
  EXPECT_LT(cost_of_box(above), 3.0);
  EXPECT_GT(cost_of_box(below), 100.0);
}

/// A pyramid on a square warped up and down by `warp` at its corners, with its apex at a height.
double cost_of_pyramid(double warp, double height) {
  const std::array<Vec3, 4> base{Vec3{-1, -1, warp}, Vec3{1, -1, -warp}, Vec3{1, 1, warp},
                                 Vec3{-1, 1, -warp}};
  const Vec3 apex(0.0, 0.0, height);
  std::array<FaceGeometry, 5> faces;
  faces[4] = face_geometry(Face{base[3], base[2], base[1], base[0]});
  for (int k = 0; k < 4; ++k) {
    faces[k] = face_geometry(std::array{base[k], base[(k + 1) % 4], apex});
  }
  return cost::of_depth(faces);
}

TEST(CellCost, RisesSteeplyWherePyramidsBecomeConcave) {
  EXPECT_LT(cost_of_pyramid(0.0, 1.0), 1e-3);
  EXPECT_LT(cost_of_pyramid(0.1, 0.5), 0.01);
  EXPECT_GT(cost_of_pyramid(0.1, -0.01), 1000.0);
}

}  // namespace
}  // namespace hexwall::test
