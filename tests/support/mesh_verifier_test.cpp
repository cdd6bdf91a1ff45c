#include "support/mesh_verifier.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "support/block_mesh.h"
#include "support/verify_wall.h"

namespace hexwall::test {
namespace {

/// A ring of n x m quads around a tube.
Quads tube_quads(int n, int m) {
  Quads quads;
  for (int j = 0; j < m; ++j) {
    for (int i = 0; i < n; ++i) {
      const int next = (i + 1) % n;
      quads.push_back({j * n + i, j * n + next, (j + 1) * n + next, (j + 1) * n + i});
    }
  }
  return quads;
}

TEST(VerifyQuads, TakesATube) {
  const QuadVerdict verdict = verify_quads(40, tube_quads(8, 4));
  EXPECT_TRUE(verdict.faults.none()) << verdict.faults.text();
  EXPECT_EQ(verdict.edges, 8 * 5 + 8 * 4);
  EXPECT_EQ(verdict.euler_number, 0);
  EXPECT_EQ(verdict.components, 1);
  EXPECT_EQ(verdict.boundary_loops, 2);
  for (int v = 0; v < 40; ++v) {
    const bool is_end = v < 8 || v >= 32;
    EXPECT_EQ(verdict.on_boundary[v] != 0, is_end);
    EXPECT_EQ(verdict.valence[v], is_end ? 3 : 4);
  }
}

TEST(VerifyQuads, AHoleChangesLoopsAndEulerNumber) {
  Quads quads = tube_quads(8, 4);
  quads.erase(quads.begin() + 10);
  const QuadVerdict verdict = verify_quads(40, quads);
  EXPECT_TRUE(verdict.faults.none()) << verdict.faults.text();
  EXPECT_EQ(verdict.boundary_loops, 3);
  EXPECT_EQ(verdict.euler_number, -1);
}

TEST(VerifyQuads, TwoTubesAreTwoComponents) {
  Quads quads = tube_quads(8, 4);
  for (auto quad : tube_quads(8, 4)) {
    for (int& v : quad) v += 40;
    quads.push_back(quad);
  }
  const QuadVerdict verdict = verify_quads(80, quads);
  EXPECT_TRUE(verdict.faults.none());
  EXPECT_EQ(verdict.components, 2);
  EXPECT_EQ(verdict.boundary_loops, 4);
}

TEST(VerifyQuads, FindsADoubledQuad) {
  Quads quads = tube_quads(8, 4);
  quads.push_back(quads[10]);
  EXPECT_TRUE(verify_quads(40, quads).faults.mention("same way"));
}

TEST(VerifyQuads, FindsAFlippedQuad) {
  Quads quads = tube_quads(8, 4);
  std::swap(quads[10][1], quads[10][3]);
  EXPECT_TRUE(verify_quads(40, quads).faults.mention("same way"));
}

TEST(VerifyQuads, FindsAVertexOfTwoFans) {
  Quads quads = tube_quads(8, 4);
  // Two quads that touch at a corner are left out: the corner joins two fans.
  quads.erase(quads.begin() + 19);
  quads.erase(quads.begin() + 10);
  EXPECT_TRUE(verify_quads(40, quads).faults.mention("several fans"));
}

TEST(VerifyQuads, FindsBadIndicesAndUnusedVertices) {
  Quads quads = tube_quads(8, 4);
  EXPECT_TRUE(verify_quads(39, quads).faults.mention("out of range"));
  EXPECT_TRUE(verify_quads(41, quads).faults.mention("unused"));
  quads[3][2] = quads[3][0];
  EXPECT_TRUE(verify_quads(40, quads).faults.mention("repeated"));
}

class VerifyHexes : public testing::Test {
 protected:
  VerifyHexes() : tube_{16, 5, 3, 1.0, 1.5, 3.0} {
    const HexMesh mesh = block_mesh(tube_);
    points_ = mesh.points;
    hexes_ = hexes_of(mesh);
    patches_ = faces_of_patches(mesh);
  }
  HexVerdict verdict() const { return verify_hexes(points_, hexes_, patches_); }

  BlockTube tube_;
  Points points_;
  Hexes hexes_;
  std::vector<Quads> patches_;
};

TEST_F(VerifyHexes, TakesATubeAndKnowsItsVolume) {
  const HexVerdict v = verdict();
  EXPECT_TRUE(v.faults.none()) << v.faults.text();
  EXPECT_NEAR(v.hex_volume, volume(tube_), 1e-12);
  EXPECT_NEAR(v.boundary_volume, volume(tube_), 1e-12);
  EXPECT_NEAR(v.min_scaled_jacobian, std::cos(std::numbers::pi / 16), 1e-12);
}

TEST_F(VerifyHexes, VolumesAgreeWithWarpedFaces) {
  for (std::size_t i = 0; i < points_.size(); ++i) {
    points_[i] += 0.02 * Eigen::Vector3d(std::sin(7.0 * static_cast<double>(i)),
                                         std::cos(5.0 * static_cast<double>(i)),
                                         std::sin(3.0 * static_cast<double>(i)));
  }
  const HexVerdict v = verdict();
  EXPECT_TRUE(v.faults.none()) << v.faults.text();
  EXPECT_NEAR(v.hex_volume, v.boundary_volume, 1e-12);
}

TEST_F(VerifyHexes, FindsAnInvertedHex) {
  std::swap(points_[hexes_[20][0]], points_[hexes_[20][1]]);
  const HexVerdict v = verdict();
  EXPECT_TRUE(v.faults.mention("not positive"));
  EXPECT_LT(v.min_scaled_jacobian, 0.0);
}

TEST_F(VerifyHexes, FindsOneBadCornerOfAHexOfPositiveVolume) {
  points_[hexes_[20][6]] = points_[hexes_[20][0]];
  EXPECT_TRUE(verdict().faults.mention("not positive"));
}

TEST_F(VerifyHexes, FindsCoordinatesThatAreNoNumbers) {
  points_[5].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(verdict().faults.mention("not positive"));
}

TEST_F(VerifyHexes, FindsAHole) {
  hexes_.erase(hexes_.begin() + 100);
  EXPECT_TRUE(verdict().faults.mention("without patch"));
}

TEST_F(VerifyHexes, FindsADoubledHex) {
  hexes_.push_back(hexes_[100]);
  EXPECT_TRUE(verdict().faults.mention("more than two hexes"));
}

TEST_F(VerifyHexes, FindsAReversedHex) {
  auto& h = hexes_[100];
  std::swap(h[1], h[3]);
  std::swap(h[5], h[7]);
  EXPECT_TRUE(verdict().faults.mention("same side"));
}

TEST_F(VerifyHexes, FindsATwistedHex) {
  auto& h = hexes_[100];
  h = {h[0], h[1], h[2], h[3], h[5], h[6], h[7], h[4]};
  EXPECT_FALSE(verdict().faults.none());
}

TEST_F(VerifyHexes, FindsAMissingPatchFace) {
  patches_[1].pop_back();
  const HexVerdict v = verdict();
  EXPECT_EQ(v.faults.count(), 1);
  EXPECT_TRUE(v.faults.mention("without patch"));
  EXPECT_GT(std::abs(v.hex_volume - v.boundary_volume), 1e-3);
}

TEST_F(VerifyHexes, FindsADoubledPatchFace) {
  patches_[0].push_back(patches_[2][0]);
  patches_[0].push_back(patches_[0][0]);
  EXPECT_EQ(verdict().faults.count(), 2);
  EXPECT_TRUE(verdict().faults.mention("more than once"));
}

TEST_F(VerifyHexes, FindsAPatchFaceThatLooksInward) {
  std::swap(patches_[0][0][1], patches_[0][0][3]);
  EXPECT_TRUE(verdict().faults.mention("looks inward"));
}

TEST_F(VerifyHexes, FindsAPatchFaceInside) {
  const auto& h = hexes_[0];
  patches_[0].push_back({h[4], h[5], h[6], h[7]});
  EXPECT_TRUE(verdict().faults.mention("not on the boundary"));
}

TEST_F(VerifyHexes, FindsUnusedVertices) {
  points_.emplace_back(0, 0, 0);
  EXPECT_TRUE(verdict().faults.mention("unused"));
}

}  // namespace
}  // namespace hexwall::test
