#include "foliation/level_order.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "dec/laplace.h"
#include "support/expect_error.h"
#include "support/harmonic_forms.h"

namespace hexwall {
namespace {

TEST(LevelRanks, OrderByValueThenByNumber) {
  const TriangleSurface surface = cylinder(1.0, 3.0, 8, 6);
  const Connectivity mesh = connectivity_of(surface);
  Eigen::VectorXd y(mesh.vertex_count());
  for (int v = 0; v < mesh.vertex_count(); ++v) y[v] = surface.points[v].z();  // ties on each ring
  const std::vector<int> ranks = level_ranks(mesh, y);
  for (int a = 0; a < mesh.vertex_count(); ++a) {
    for (int b = 0; b < mesh.vertex_count(); ++b) {
      if (y[a] < y[b]) {
        ASSERT_LT(ranks[a], ranks[b]);
      } else if (y[a] > y[b] || a >= b) {
        continue;
      } else if (mesh.is_boundary_vertex(a)) {
        ASSERT_EQ(ranks[a], ranks[b]);
      } else {
        ASSERT_LT(ranks[a], ranks[b]);
      }
    }
  }
  EXPECT_EQ(*std::min_element(ranks.begin(), ranks.end()), 0);
  const std::set<int> distinct(ranks.begin(), ranks.end());
  EXPECT_EQ(*distinct.rbegin() + 1, static_cast<int>(distinct.size()));
}

TEST(LevelRanks, LoopsOfEqualValueStayApart) {
  const TriangleSurface surface = cylinder(1.0, 3.0, 8, 6);
  const Connectivity mesh = connectivity_of(surface);
  const std::vector<int> ranks = level_ranks(mesh, Eigen::VectorXd::Zero(mesh.vertex_count()));
  EXPECT_NE(ranks[mesh.loops()[0].front()], ranks[mesh.loops()[1].front()]);
}

TEST(FindZeros, NoneOnAnAnnulus) {
  const test::Harmonic h = test::harmonic(*test::vessel_surface("eccentric_annulus"));
  EXPECT_TRUE(find_zeros(h.mesh, level_ranks(h.mesh, h.basis.f.col(0))).empty());
}

TEST(FindZeros, RefusesAnInteriorExtremum) {
  const TriangleSurface surface = cylinder(1.0, 3.0, 12, 8);
  const Connectivity mesh = connectivity_of(surface);
  Eigen::VectorXd y(mesh.vertex_count());
  for (int v = 0; v < mesh.vertex_count(); ++v) y[v] = surface.points[v].z();
  y[4 * 12 + 3] += 5.0;
  test::expect_error(ExitCode::meshing, {"extremum", "interior vertex 51"},
                     [&] { find_zeros(mesh, level_ranks(mesh, y)); });
}

// A torus with two holes: the zeros of a harmonic function have total order 2, not 0.
TEST(FindZeros, RefusesAHandle) {
  const int m = 14;
  const int k = 9;
  TriangleSurface torus;
  for (int i = 0; i < m; ++i) {
    for (int j = 0; j < k; ++j) {
      const double a = 2.0 * std::numbers::pi * i / m;
      const double b = 2.0 * std::numbers::pi * j / k;
      torus.points.emplace_back((3.0 + std::cos(b)) * std::cos(a),
                                (3.0 + std::cos(b)) * std::sin(a), std::sin(b));
    }
  }
  const auto number = [&](int i, int j) { return (i % m) * k + j % k; };
  const std::set<int> holes{number(2, 3), number(8, 1)};
  for (int i = 0; i < m; ++i) {
    for (int j = 0; j < k; ++j) {
      for (const std::array<int, 3>& t :
           {std::array{number(i, j), number(i + 1, j), number(i + 1, j + 1)},
            std::array{number(i, j), number(i + 1, j + 1), number(i, j + 1)}}) {
        if (std::none_of(t.begin(), t.end(), [&](int v) { return holes.contains(v); })) {
          torus.triangles.push_back(t);
        }
      }
    }
  }
  const Connectivity mesh = connectivity_of(torus);
  ASSERT_EQ(mesh.loops().size(), 2U);
  Eigen::MatrixXd boundary = Eigen::MatrixXd::Zero(mesh.vertex_count(), 1);
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    boundary(v, 0) = mesh.loop_of_vertex(v) == 1 ? 1.0 : 0.0;
  }
  // Weights that break the ties of the grid.
  Eigen::VectorXd weights(mesh.edge_count());
  for (int e = 0; e < mesh.edge_count(); ++e) weights[e] = 1.0 + 0.1 * std::sin(e);
  const Eigen::VectorXd y = LaplaceSolver(mesh, weights).harmonic_extension(boundary).col(0);
  test::expect_error(ExitCode::meshing, {"total order 2", "expected 0"},
                     [&] { find_zeros(mesh, level_ranks(mesh, y)); });
}

}  // namespace
}  // namespace hexwall
