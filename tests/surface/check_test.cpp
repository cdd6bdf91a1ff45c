#include "surface/check.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "support/expect_error.h"
#include "support/outcomes.h"
#include "support/shared_data.h"
#include "surface/connectivity.h"
#include "surface/generate.h"
#include "surface/handles.h"
#include "surface/orient.h"
#include "surface/read.h"
#include "surface/self_intersection.h"

namespace hexwall {
namespace {

using std::numbers::pi;
using test::expect_error;

void expect_refused(const TriangleSurface& surface, ExitCode code,
                    std::initializer_list<const char*> words) {
  expect_error(code, words, [&] { check_surface(surface); });
}

TriangleSurface tube() {
  return cylinder(1.0, 3.0, 16, 6);
}

/// Adds a copy of `other`, moved by `offset`; returns the number of its first vertex.
int append(TriangleSurface& surface, const TriangleSurface& other, const Vec3& offset) {
  const int first = static_cast<int>(surface.points.size());
  for (const Vec3& p : other.points) surface.points.push_back(p + offset);
  for (const auto& [a, b, c] : other.triangles) {
    surface.triangles.push_back({a + first, b + first, c + first});
  }
  return first;
}

/// A band of n quads, closed with `half_twists` half turns.
TriangleSurface band(int n, int half_twists) {
  TriangleSurface surface;
  for (int i = 0; i < n; ++i) {
    const double angle = 2.0 * pi * i / n;
    const double twist = 0.5 * half_twists * angle;
    const Vec3 out(std::cos(angle), std::sin(angle), 0.0);
    const Vec3 across = std::cos(twist) * Vec3::UnitZ() + std::sin(twist) * out;
    surface.points.push_back(2.0 * out - 0.5 * across);
    surface.points.push_back(2.0 * out + 0.5 * across);
  }
  for (int i = 0; i < n; ++i) {
    const bool is_swapped = i + 1 == n && half_twists % 2 == 1;
    const int next = 2 * ((i + 1) % n);
    const int low = is_swapped ? next + 1 : next;
    const int high = is_swapped ? next : next + 1;
    surface.triangles.push_back({2 * i, low, 2 * i + 1});
    surface.triangles.push_back({2 * i + 1, low, high});
  }
  return surface;
}

/// A torus of n by m quads, without those of `holes`.
TriangleSurface torus(int n, int m, const std::vector<std::pair<int, int>>& holes) {
  TriangleSurface surface;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < m; ++j) {
      const double u = 2.0 * pi * i / n;
      const double v = 2.0 * pi * j / m;
      const double r = 3.0 + std::cos(v);
      surface.points.emplace_back(r * std::cos(u), r * std::sin(u), std::sin(v));
    }
  }
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < m; ++j) {
      if (std::find(holes.begin(), holes.end(), std::pair(i, j)) != holes.end()) continue;
      const int a = i * m + j;
      const int b = (i + 1) % n * m + j;
      const int c = (i + 1) % n * m + (j + 1) % m;
      const int d = i * m + (j + 1) % m;
      surface.triangles.push_back({a, b, c});
      surface.triangles.push_back({a, c, d});
    }
  }
  return surface;
}

TriangleSurface octahedron() {
  return {{{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
          {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}, {1, 0, 5}, {2, 1, 5}, {3, 2, 5}, {0, 3, 5}}};
}

// --- geometry -----------------------------------------------------------------------------------

TEST(CheckSurface, RefusesNonFiniteCoordinates) {
  TriangleSurface surface = tube();
  surface.points[7].y() = std::numeric_limits<double>::quiet_NaN();
  surface.points[9].z() = std::numeric_limits<double>::infinity();
  expect_refused(surface, ExitCode::geometry, {"2 vertices", "not finite", "vertex 7", "vertex 9"});
}

TEST(CheckSurface, IgnoresNonFinitePointsWithoutTriangles) {
  TriangleSurface surface = tube();
  const Vec3 nowhere = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  surface.points.insert(surface.points.begin(), nowhere);
  for (auto& t : surface.triangles) {
    for (int& v : t) ++v;
  }
  EXPECT_EQ(check_surface(surface).flipped, 0);
}

TEST(CheckSurface, RefusesRepeatedVertices) {
  TriangleSurface surface = tube();
  surface.triangles.push_back({4, 5, 4});
  expect_refused(surface, ExitCode::geometry, {"1 triangle uses", "twice", "triangle 192"});
}

TEST(CheckSurface, RefusesTrianglesWithoutArea) {
  TriangleSurface surface = tube();
  const auto [a, b, c] = surface.triangles[50];
  surface.points[a] = 0.5 * (surface.points[b] + surface.points[c]);
  expect_refused(surface, ExitCode::geometry, {"zero area", "triangle 50"});
}

TEST(CheckSurface, TakesThinTrianglesThatHaveArea) {
  EXPECT_NO_THROW(check_surface(cylinder(1.0, 1e-6, 16, 1)));
  EXPECT_NO_THROW(check_surface(cylinder(1e-9, 1e-9, 16, 4)));
}

TEST(CheckSurface, RefusesSelfIntersections) {
  TriangleSurface surface = cylinder(1.0, 3.0, 16, 6);
  // The end ring, moved through the opposite wall.
  for (int i = 0; i < 16; ++i) surface.points[i] += Vec3(2.5, 0, -2.5);
  expect_refused(surface, ExitCode::geometry, {"self-intersection", "pairs", "near"});
}

TEST(SelfIntersections, FindsExactlyTheCrossingPair) {
  TriangleSurface surface{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -1}, {1, 1, 1}, {9, 9, 0}},
                          {{0, 1, 2}, {3, 4, 5}}};
  const std::vector<std::pair<int, int>> expected{{0, 1}};
  EXPECT_EQ(self_intersections(surface), expected);
  for (int v = 3; v < 6; ++v) surface.points[v].z() += 3.0;
  EXPECT_TRUE(self_intersections(surface).empty());
}

// --- topology -----------------------------------------------------------------------------------

TEST(CheckSurface, RefusesEmptySurfaces) {
  expect_refused({}, ExitCode::topology, {"no triangles"});
}

TEST(CheckSurface, RefusesSeveralComponents) {
  TriangleSurface surface = tube();
  append(surface, octahedron(), {10, 0, 0});
  expect_refused(surface, ExitCode::topology, {"2 connected components", "192, 8"});
}

TEST(CheckSurface, RefusesNonManifoldEdges) {
  TriangleSurface surface = tube();
  surface.points.emplace_back(3, 0, 1.5);
  const auto& t = surface.triangles[80];
  surface.triangles.push_back({t[0], t[1], static_cast<int>(surface.points.size()) - 1});
  expect_refused(surface, ExitCode::topology, {"not manifold", "1 edge has more", "has 3"});
}

TEST(CheckSurface, RefusesMobiusBands) {
  expect_refused(band(24, 1), ExitCode::topology, {"not orientable", "Moebius"});
  expect_refused(band(24, 3), ExitCode::topology, {"not orientable"});
}

TEST(CheckSurface, TakesFullTwists) {
  EXPECT_NO_THROW(check_surface(band(48, 2)));
}

TEST(CheckSurface, RefusesBowTies) {
  TriangleSurface surface = tube();
  const int first = append(surface, tube(), {2.0, 0, 0});
  // Vertex 40 lies on the side where both tubes touch.
  for (auto& t : surface.triangles) {
    for (int& v : t) {
      if (v == first + 40) v = 32;
    }
  }
  expect_refused(surface, ExitCode::topology, {"touch in a single point", "vertex 32"});
}

TEST(CheckSurface, RefusesClosedSurfaces) {
  expect_refused(octahedron(), ExitCode::topology, {"closed", "caps", "Cut"});
}

TEST(CheckSurface, RefusesDisks) {
  TriangleSurface disk = octahedron();
  disk.triangles.pop_back();
  expect_refused(disk, ExitCode::topology, {"only one boundary loop"});
}

TEST(CheckSurface, RefusesHandles) {
  expect_refused(torus(24, 12, {{0, 0}, {12, 3}}), ExitCode::topology, {"genus 1", "1 handle,"});
}

/// The shortest line that does not divide a torus is a meridian: 12 edges around the tube.
TEST(CheckSurface, ShowsAShortLineAroundAHandle) {
  const TriangleSurface surface = torus(24, 12, {{0, 0}, {12, 3}});
  const auto problems = find_problems(surface);
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].places.size(), 12U);
  Vec3 last = problems[0].places.back();
  for (const Vec3& p : problems[0].places) {
    EXPECT_NEAR((p - last).norm(), 2.0 * std::sin(pi / 12), 1e-9);
    last = p;
  }
}

/// Lines around a tube divide it.
TEST(HandleLine, IsEmptyWithoutHandles) {
  const TriangleSurface surface = tube();
  const Connectivity mesh = connectivity_of(surface);
  EXPECT_TRUE(handle_line(surface, mesh).empty());
}

// --- order of the checks ------------------------------------------------------------------------

TEST(CheckSurface, ReportsTheFirstClassOnly) {
  TriangleSurface surface = octahedron();
  append(surface, octahedron(), {5, 0, 0});
  expect_refused(surface, ExitCode::topology, {"components"});
  surface.triangles.push_back({0, 0, 1});
  expect_refused(surface, ExitCode::geometry, {"twice"});
  surface.points[0].x() = std::numeric_limits<double>::quiet_NaN();
  expect_refused(surface, ExitCode::geometry, {"not finite"});
}

TEST(CheckSurface, NamesAtMostThreeExamples) {
  TriangleSurface surface = tube();
  for (Vec3& p : surface.points) p.x() = std::numeric_limits<double>::quiet_NaN();
  expect_refused(surface, ExitCode::geometry, {"112 vertices", "vertex 2 ", "and more"});
  try {
    check_surface(surface);
  } catch (const GeometryError& error) {
    EXPECT_EQ(std::string(error.what()).find("vertex 3"), std::string::npos);
  }
}

// --- orientation --------------------------------------------------------------------------------

double volume_of_prism(int n, double length) {
  return 0.5 * n * std::sin(2.0 * pi / n) * length;
}

TEST(Orient, SignedVolumeClosesTheLoops) {
  TriangleSurface surface;
  // Rows that are not staggered give a prism exactly.
  const int n = 12;
  for (int row = 0; row < 2; ++row) {
    for (int i = 0; i < n; ++i) {
      surface.points.emplace_back(std::cos(2 * pi * i / n) + 50, std::sin(2 * pi * i / n), 4 * row);
    }
  }
  for (int i = 0; i < n; ++i) {
    const int next = (i + 1) % n;
    surface.triangles.push_back({i, next, n + i});
    surface.triangles.push_back({next, n + next, n + i});
  }
  EXPECT_NEAR(signed_volume(surface), volume_of_prism(n, 4.0), 1e-12);
}

TEST(Orient, TurnsSingleTrianglesAndCountsThem) {
  TriangleSurface surface = tube();
  for (const int f : {3, 70, 71, 150}) std::swap(surface.triangles[f][0], surface.triangles[f][2]);
  const CheckResult result = check_surface(surface);
  EXPECT_EQ(result.flipped, 4);
  ASSERT_EQ(result.notes.size(), 1U);
  EXPECT_NE(result.notes[0].find("4 triangles had the wrong winding"), std::string::npos);
  EXPECT_GT(signed_volume(result.surface), 0.0);
}

TEST(Orient, TurnsTheSurfaceOutward) {
  TriangleSurface surface = tube();
  for (auto& t : surface.triangles) std::swap(t[1], t[2]);
  const CheckResult result = check_surface(surface);
  EXPECT_EQ(result.flipped, 192);
  EXPECT_EQ(result.surface.triangles, tube().triangles);
  EXPECT_NE(result.notes[0].find("inward"), std::string::npos);
}

TEST(Orient, KeepsTheWindingOfFlatSurfaces) {
  const TriangleSurface up = annulus(1.0, 2.0, 24, 4);
  TriangleSurface down = up;
  for (auto& t : down.triangles) std::swap(t[1], t[2]);
  EXPECT_EQ(orient(up).flipped, 0);
  EXPECT_EQ(orient(down).flipped, 0);
  std::swap(down.triangles[0][1], down.triangles[0][2]);
  EXPECT_EQ(orient(down).flipped, 1);
}

TEST(Orient, IsTheSameFarFromTheOriginAndInAnyUnit) {
  for (const double scale : {1e-6, 1.0, 1e6}) {
    TriangleSurface surface = tube();
    for (Vec3& p : surface.points) p = scale * (p + Vec3(1e3, -2e3, 5e2));
    EXPECT_EQ(check_surface(surface).flipped, 0);
    for (auto& t : surface.triangles) std::swap(t[1], t[2]);
    EXPECT_EQ(check_surface(surface).flipped, 192);
  }
}

TEST(CheckSurface, TakesAGoodSurfaceAsItIs) {
  const TriangleSurface surface = tube();
  const CheckResult result = check_surface(surface);
  EXPECT_EQ(result.surface.points, surface.points);
  EXPECT_EQ(result.surface.triangles, surface.triangles);
  EXPECT_TRUE(result.notes.empty());
}

// --- real surfaces ------------------------------------------------------------------------------

class CheckedFiles : public testing::TestWithParam<test::Outcome> {};

TEST_P(CheckedFiles, AreTakenOrRefusedForTheRightReason) {
  const auto folder = test::shared_data();
  if (!folder) GTEST_SKIP() << "no folder of shared data; set HEXWALL_SHARED_DATA";
  const test::Outcome& expected = GetParam();
  const TriangleSurface surface = read_surface(*folder / expected.surface).surface;
  if (!expected.is_clean()) {
    expect_refused(surface, ExitCode::topology, {expected.untouched.c_str()});
    return;
  }
  const CheckResult result = check_surface(surface);
  const Connectivity mesh(static_cast<int>(surface.points.size()), result.surface.triangles);
  const int loops = expected.counts.openings;
  EXPECT_EQ(static_cast<int>(mesh.loops().size()), loops);
  EXPECT_EQ(mesh.euler_number(), 2 - loops);
}

INSTANTIATE_TEST_SUITE_P(CheckSurface, CheckedFiles, testing::ValuesIn(test::shared_files()));

}  // namespace
}  // namespace hexwall
