#include <array>
#include <cmath>
#include <map>
#include <vector>

#include <gtest/gtest.h>

#include "support/foliation_checks.h"
#include "surface/vessel_tree.h"

namespace hexwall {
namespace {

using test::Foliated;
using test::foliated;
using test::FoliationChecks;

// Four equal branches that meet at right angles.
TriangleSurface cross_vessel(double edge) {
  return vessel_tree({{{{-5, 0, 0}, {0, 0, 0}, {5, 0, 0}}, {1, 1, 1}, true, true, 0.0},
                      {{{0, -5, 0}, {0, 0, 0}, {0, 5, 0}}, {1, 1, 1}, true, true, 0.4}},
                     edge);
}

// Number of the loop around `direction`.
int loop_at(const Foliated& s, const Vec3& direction) {
  int best = 0;
  const auto& loops = s.mesh().loops();
  const auto reach = [&](int i) { return s.h.surface().points[loops[i].front()].dot(direction); };
  for (int i = 1; i < static_cast<int>(loops.size()); ++i) best = reach(i) > reach(best) ? i : best;
  return best;
}

// The form whose flux enters through the loops of greatest and leaves through those of least |x|.
Foliated with_periods(const TriangleSurface& surface, const std::array<double, 4>& px_mx_py_my) {
  Foliated s;
  s.h = test::harmonic(surface);
  Eigen::VectorXd periods(4);
  const std::array<Vec3, 4> directions{Vec3::UnitX(), -Vec3::UnitX(), Vec3::UnitY(),
                                       -Vec3::UnitY()};
  for (int i = 0; i < 4; ++i) periods[loop_at(s, directions[i])] = px_mx_py_my[i];
  const Eigen::VectorXd lambda = periods.tail(3);  // loop 0 is the exterior one
  return foliated(std::move(s.h), lambda);
}

// From opposite to opposite, neighbour to neighbour, one to three, and without flux in two.
constexpr std::array<std::array<double, 4>, 4> patterns{
    {{1, 1, -1, -1}, {1, -1, 1, -1}, {3, -1, -1, -1}, {1, -1, 0, 0}}};

TEST(CrossVessel, IsValidForItsOptimum) {
  const Foliated s = foliated(cross_vessel(0.35));
  EXPECT_EQ(s.h.n(), 3);
  FoliationChecks(s).all();
}

TEST(CrossVessel, IsValidForSymmetricForms) {
  const TriangleSurface surface = cross_vessel(0.35);
  for (const auto& pattern : patterns) {
    SCOPED_TRACE(testing::Message() << pattern[0] << pattern[1] << pattern[2] << pattern[3]);
    FoliationChecks(with_periods(surface, pattern)).all();
  }
}

// The boundary of a union of unit cubes without the faces at the arms' ends; each square is split
// into four by its centre, so that every symmetry of the cubes is one of the triangles.
class CubeSurface {
 public:
  explicit CubeSurface(int half_width, int reach) : w_(half_width), reach_(reach) {
    for (int x = -reach; x < reach; ++x) {
      for (int y = -reach; y < reach; ++y) {
        for (int z = -w_; z < w_; ++z) {
          if (is_inside(x, y, z)) add_cube(x, y, z);
        }
      }
    }
  }
  TriangleSurface take() { return std::move(surface_); }

 private:
  bool is_inside(int x, int y, int z) const {
    const auto within = [](int i, int bound) { return i >= -bound && i < bound; };
    return within(z, w_) &&
           ((within(x, reach_) && within(y, w_)) || (within(y, reach_) && within(x, w_)));
  }

  bool is_open_end(int x, int y) const {
    return x < -reach_ || x >= reach_ || y < -reach_ || y >= reach_;
  }

  // Points are numbered by twice their coordinates.
  int point(const std::array<int, 3>& doubled) {
    const auto [at, is_new] =
        numbers_.try_emplace(doubled, static_cast<int>(surface_.points.size()));
    if (is_new) {
      surface_.points.emplace_back(0.5 * doubled[0], 0.5 * doubled[1], 0.5 * doubled[2]);
    }
    return at->second;
  }

  void add_cube(int x, int y, int z) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const int side : {-1, 1}) {
        std::array<int, 3> cube{x, y, z};
        cube[axis] += side;
        if (is_inside(cube[0], cube[1], cube[2]) || is_open_end(cube[0], cube[1])) continue;
        add_square({2 * x + 1, 2 * y + 1, 2 * z + 1}, axis, side);
      }
    }
  }

  void add_square(std::array<int, 3> center, int axis, int side) {
    center[axis] += side;
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    std::array<int, 4> corners{};
    constexpr std::array<std::array<int, 2>, 4> turns{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
    for (int k = 0; k < 4; ++k) {
      std::array<int, 3> corner = center;
      corner[u] += turns[k][0];
      corner[v] += turns[k][1] * side;  // counter-clockwise seen from outside
      corners[k] = point(corner);
    }
    const int middle = point(center);
    for (int k = 0; k < 4; ++k) {
      surface_.triangles.push_back({corners[k], corners[(k + 1) % 4], middle});
    }
  }

  int w_, reach_;
  TriangleSurface surface_;
  std::map<std::array<int, 3>, int> numbers_;
};

// Ties everywhere: zeros on one level above each other, level curves through rows of vertices.
TEST(CrossOfCubes, IsValidForSymmetricForms) {
  for (const int half_width : {1, 2}) {
    const TriangleSurface surface = CubeSurface(half_width, 5 * half_width).take();
    ASSERT_EQ(check_surface(surface).flipped, 0);
    for (const auto& pattern : patterns) {
      SCOPED_TRACE(testing::Message() << "half width " << half_width << ": " << pattern[0]
                                      << pattern[1] << pattern[2] << pattern[3]);
      const Foliated s = with_periods(surface, pattern);
      ASSERT_EQ(s.h.n(), 3);
      FoliationChecks(s).all();
    }
  }
}

TEST(CrossOfCubes, ZerosOfTheQuadrupoleLieOnTheAxis) {
  const Foliated s = with_periods(CubeSurface(2, 10).take(), {1, 1, -1, -1});
  ASSERT_EQ(s.foliation.interior_zeros(), 2);
  ASSERT_EQ(s.foliation.graph.zeros.size(), 2U);
  for (const Zero& zero : s.foliation.graph.zeros) {
    const Vec3& p = s.h.surface().points[zero.vertex];
    EXPECT_LT(std::hypot(p.x(), p.y()), 1.5);
    EXPECT_NEAR(std::abs(p.z()), 2.0, 1e-12);
  }
}

// A hexagon of the triangular lattice around the origin with hexagonal holes.
TriangleSurface lattice(int radius, const std::vector<std::array<int, 2>>& holes) {
  std::map<std::array<int, 2>, int> numbers;
  TriangleSurface surface;
  const auto is_inside = [&](int i, int j) {
    return std::max({std::abs(i), std::abs(j), std::abs(i + j)}) <= radius;
  };
  for (int i = -radius; i <= radius; ++i) {
    for (int j = -radius; j <= radius; ++j) {
      if (!is_inside(i, j)) continue;
      numbers[{i, j}] = static_cast<int>(surface.points.size());
      surface.points.emplace_back(i + 0.5 * j, std::sqrt(0.75) * j, 0.0);
    }
  }
  const auto add = [&](std::array<std::array<int, 2>, 3> corners) {
    std::array<int, 3> triangle{};
    for (int k = 0; k < 3; ++k) {
      const auto& corner = corners[k];
      if (!numbers.contains(corner)) return;
      if (std::find(holes.begin(), holes.end(), corner) != holes.end()) return;
      triangle[k] = numbers[corner];
    }
    surface.triangles.push_back(triangle);
  };
  for (int i = -radius; i <= radius; ++i) {
    for (int j = -radius; j <= radius; ++j) {
      add({{{i, j}, {i + 1, j}, {i, j + 1}}});
      add({{{i + 1, j}, {i + 1, j + 1}, {i, j + 1}}});
    }
  }
  return surface;
}

// Three equal sinks around the origin, the flux comes from outside: a monkey saddle.
TEST(ThreefoldSymmetricPlane, HasOneDoubleZeroInTheMiddle) {
  const TriangleSurface surface = lattice(9, {{4, 0}, {-4, 4}, {0, -4}});
  test::Harmonic h = test::harmonic(surface);
  ASSERT_EQ(h.n(), 3);
  const auto& loops = h.mesh.loops();
  Eigen::VectorXd periods(4);
  for (int i = 0; i < 4; ++i) periods[i] = loops[i].size() > 10 ? 3.0 : -1.0;
  const Eigen::VectorXd lambda = periods.tail(3);
  const Foliated s = foliated(std::move(h), lambda);
  ASSERT_EQ(s.foliation.graph.zeros.size(), 1U);
  EXPECT_EQ(s.foliation.graph.zeros.front().doubled_order, 4);
  EXPECT_LT(s.h.surface().points[s.foliation.graph.zeros.front().vertex].norm(), 1e-12);
  // One cylinder from outside and one to each hole; the six sectors of the zero cut three strips.
  EXPECT_EQ(s.foliation.cylinders.size(), 4U);
  EXPECT_EQ(s.foliation.strips.count(), 3);
  FoliationChecks(s).all();
}

TEST(TwofoldSymmetricPlane, IsValid) {
  const TriangleSurface surface = lattice(9, {{4, 0}, {-4, 0}});
  for (const auto& pair : {std::array{-1.0, -1.0}, std::array{1.0, -1.0}}) {
    test::Harmonic h = test::harmonic(surface);
    Eigen::VectorXd periods(3);
    int hole = 0;
    for (int i = 0; i < 3; ++i) {
      periods[i] = h.mesh.loops()[i].size() > 10 ? -pair[0] - pair[1] : pair[hole++];
    }
    const Eigen::VectorXd lambda = periods.tail(2);
    FoliationChecks(foliated(std::move(h), lambda)).all();
  }
}

// Six equal sinks: at the origin y equals all of its six neighbours, up to rounding.
TEST(SixfoldSymmetricPlane, IsValidThoughTheMiddleIsFlat) {
  const TriangleSurface surface = lattice(9, {{4, 0}, {0, 4}, {-4, 4}, {-4, 0}, {0, -4}, {4, -4}});
  test::Harmonic h = test::harmonic(surface);
  ASSERT_EQ(h.n(), 6);
  Eigen::VectorXd periods(7);
  for (int i = 0; i < 7; ++i) periods[i] = h.mesh.loops()[i].size() > 10 ? 6.0 : -1.0;
  const Eigen::VectorXd lambda = periods.tail(6);
  FoliationChecks(foliated(std::move(h), lambda)).all();
}

}  // namespace
}  // namespace hexwall
