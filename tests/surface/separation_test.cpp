// Planes between faces: never where these meet, and nearly always where they don't.

#include "surface/separation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <gtest/gtest.h>

#include "surface/generate.h"
#include "surface/self_intersection.h"

namespace hexwall {
namespace {

class MeetingFaces : public testing::Test {
 protected:
  double number(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  Vec3 place() { return {number(-1, 1), number(-1, 1), number(-1, 1)}; }

  // The third corner of a triangle of which `inside` is an inner point.
  Vec3 third_corner(const Vec3& a, const Vec3& b, const Vec3& inside) {
    const double of_a = number(0.1, 0.4);
    const double of_b = number(0.1, 0.4);
    return (inside - of_a * a - of_b * b) / (1.0 - of_a - of_b);
  }

  std::mt19937_64 random_{1};
};

// Two triangles with a point inside both; in the second half of the trials with a corner in common.
TEST_F(MeetingFaces, AreNotSeparatedWithAtMostACommonVertex) {
  for (int i = 0; i < 4000; ++i) {
    const int first = i < 2000 ? 3 : 0;  // of the second triangle
    const Vec3 common = place();
    std::vector<Vec3> points{place(), place(), Vec3(), place(), place(), Vec3()};
    points[2] = third_corner(points[0], points[1], common);
    points[5] = third_corner(points[first], points[4], common);
    const std::array<int, 3> a{0, 1, 2};
    const std::array<int, 3> b{4, 5, first};
    EXPECT_FALSE(Separation(points).is_certain(a, b)) << i;
  }
}

// Two quads with the edge 0-1, each with a triangle of one way to split it through one place.
TEST_F(MeetingFaces, AreNotSeparatedAtACommonEdge) {
  for (int i = 0; i < 2000; ++i) {
    const Vec3 common = place();
    std::vector<Vec3> points{place(), place(), place(), Vec3(), place(), Vec3()};
    points[3] = third_corner(points[1], points[2], common);
    points[5] = third_corner(points[i % 2], points[4], common);
    const std::array<int, 4> a{0, 1, 2, 3};
    const std::array<int, 4> b{1, 0, 4, 5};
    EXPECT_FALSE(Separation(points).is_certain(a, b)) << i;
  }
}

TEST_F(MeetingFaces, AreNotSeparatedIfAQuadTouchesAcross) {
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 1}, {0, 2, 1}};
  const std::array<int, 4> a{0, 1, 2, 3};
  const std::array<int, 4> b{1, 4, 3, 5};  // has corners in common that are not next to each other
  EXPECT_FALSE(Separation(points).is_certain(a, b));
}

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Corners = std::array<Kernel::Point_3, 3>;

// Whether two triangles with a common first edge meet elsewhere, by CGAL.
bool meet_beside_edge(const Corners& s, const Corners& t) {
  return !CGAL::collinear(s[0], s[1], s[2]) && !CGAL::collinear(s[0], s[1], t[2]) &&
         CGAL::coplanar(s[0], s[1], s[2], t[2]) &&
         CGAL::coplanar_orientation(s[0], s[1], s[2], t[2]) == CGAL::POSITIVE;
}

// Whether two triangles with a common first corner meet elsewhere, by CGAL.
bool meet_beside_corner(const Corners& s, const Corners& t) {
  return CGAL::do_intersect(Kernel::Triangle_3(s[0], s[1], s[2]), Kernel::Segment_3(t[1], t[2])) ||
         CGAL::do_intersect(Kernel::Triangle_3(t[0], t[1], t[2]), Kernel::Segment_3(s[1], s[2]));
}

Corners corners(const std::vector<Vec3>& points, const std::array<int, 3>& triangle) {
  Corners result;
  for (int k = 0; k < 3; ++k) {
    const Vec3& p = points[triangle[k]];
    result[k] = {p.x(), p.y(), p.z()};
  }
  return result;
}

// Whether two triangles meet: then they must not count as apart.
bool expect_not_separated(const std::vector<Vec3>& points, const std::array<int, 3>& a,
                          const std::array<int, 3>& b,
                          bool (*meet)(const Corners&, const Corners&)) {
  if (!meet(corners(points, a), corners(points, b))) return false;
  EXPECT_FALSE(Separation(points).is_certain(a, b));
  return true;
}

// Needles folded onto each other at their long edge, or nearly so, near the origin and far from it.
TEST_F(MeetingFaces, AreNotSeparatedHoweverThin) {
  int meeting = 0;
  for (int i = 0; i < 40000; ++i) {
    const Vec3 origin = i % 2 == 0 ? Vec3(0, 0, 0) : 1000.0 * place();
    Vec3 edge = place();
    edge.z() = 0.0;  // in a plane: folds are exact
    const Vec3 across = Vec3(-edge.y(), edge.x(), 0.0);
    const auto apex = [&] {
      return Vec3(origin + number(-1.0, 2.0) * edge + std::pow(10.0, number(-13.0, 0.0)) * across);
    };
    const std::vector<Vec3> points{origin, origin + edge, apex(), apex()};
    const std::array<int, 3> a{0, 1, 2};
    const std::array<int, 3> b{0, 1, 3};
    if (expect_not_separated(points, a, b, meet_beside_edge)) ++meeting;
  }
  EXPECT_GT(meeting, 10000);
}

TEST_F(MeetingFaces, AreNotSeparatedAtACornerHoweverThin) {
  int meeting = 0;
  for (int i = 0; i < 40000; ++i) {
    const Vec3 origin = i % 2 == 0 ? Vec3(0, 0, 0) : 1000.0 * place();
    const Vec3 along = place();
    const auto near = [&](double thin) {
      return Vec3(origin + number(0.1, 1.0) * along + thin * place());
    };
    const double thin = std::pow(10.0, number(-12.0, 0.0));
    const std::vector<Vec3> points{origin, near(thin), near(thin), near(thin), near(thin)};
    const std::array<int, 3> a{0, 1, 2};
    const std::array<int, 3> b{0, 3, 4};
    if (expect_not_separated(points, a, b, meet_beside_corner)) ++meeting;
  }
  EXPECT_GT(meeting, 1000);
}

TEST(Separation, IsCertainOfNeighboursOnASmoothSurface) {
  const TriangleSurface surface = cylinder(1.0, 4.0, 40, 26);
  const Separation separation(surface.points);
  std::vector<Eigen::AlignedBox3d> boxes(surface.triangles.size());
  for (std::size_t f = 0; f < boxes.size(); ++f) {
    for (const int v : surface.triangles[f]) boxes[f].extend(surface.points[v]);
  }
  const auto pairs = box_pairs(boxes, [](int, int) { return true; });
  for (const auto& [f, g] : pairs) {
    EXPECT_TRUE(separation.is_certain(surface.triangles[f], surface.triangles[g]));
  }
  // Twelve neighbours each, but at the ends.
  EXPECT_GE(pairs.size(), 6 * surface.triangles.size() - 1000);
  EXPECT_TRUE(self_intersections(surface).empty());
}

// The same pairs as each box tried against each other one; some reach through all slabs, and many
// begin where a slab does.
TEST(BoxPairs, AreAllThatMeetAndAreWanted) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> number(0.0, 1.0);
  std::vector<Eigen::AlignedBox3d> boxes;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 low(std::round(8.0 * number(random)), number(random), number(random));
    Vec3 size = 0.05 * Vec3(number(random), number(random), number(random));
    if (i % 100 == 0) size.x() = 8.0;
    boxes.emplace_back(low, low + size);
  }
  const auto is_wanted = [](int i, int j) { return (i + j) % 3 != 0; };
  std::vector<std::pair<int, int>> expected;
  for (int i = 0; i < 20000; ++i) {
    for (int j = i + 1; j < 20000; ++j) {
      if (boxes[i].intersects(boxes[j]) && is_wanted(i, j)) expected.emplace_back(i, j);
    }
  }
  EXPECT_EQ(box_pairs(boxes, is_wanted), expected);
  EXPECT_GT(expected.size(), 10000U);
  std::vector<char> is_active(boxes.size(), 0);
  for (int i = 0; i < 20000; ++i) is_active[i] = boxes[i].min().x() > 2.5 && i % 7 == 0 ? 1 : 0;
  std::erase_if(expected, [&](const auto& pair) {
    return !is_active[pair.first] && !is_active[pair.second];
  });
  EXPECT_EQ(box_pairs(boxes, is_wanted, is_active), expected);
  EXPECT_GT(expected.size(), 1000U);
  EXPECT_TRUE(box_pairs({}, is_wanted).empty());
}

}  // namespace
}  // namespace hexwall
