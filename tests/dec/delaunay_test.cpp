#include "dec/delaunay.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/tolerances.h"
#include "dec/operators.h"
#include "support/vessel_surfaces.h"
#include "surface/projector.h"

namespace hexwall {
namespace {

double area(const TriangleSurface& surface, int f) {
  return 0.5 * doubled_area_vector(surface, f).norm();
}

int negative_weights(const TriangleSurface& surface, const Connectivity& mesh) {
  const Eigen::VectorXd cotangents = halfedge_cotangents(surface);
  int count = 0;
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (mesh.is_boundary_edge(e)) continue;
    const int h = mesh.halfedge(e);
    const double sum = cotangents[h] + cotangents[mesh.twin(h)];
    count += sum < -tolerance::delaunay_cotangent ? 1 : 0;
  }
  return count;
}

void expect_no_negative_weights(const TriangleSurface& surface, const Connectivity& mesh) {
  EXPECT_EQ(negative_weights(surface, mesh), 0);
}

double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - (1.0 - t) * a - t * b).norm();
}

double distance_to_outline(const Vec3& p, const TriangleSurface& surface, int f) {
  double least = INFINITY;
  for (int k = 0; k < 3; ++k) {
    least = std::min(least, distance_to_segment(p, surface.points[surface.triangles[f][k]],
                                                surface.points[surface.triangles[f][(k + 1) % 3]]));
  }
  return least;
}

// Each triangle lies in its parent, wound alike, and each parent is covered exactly.
void expect_same_shape(const TriangleSurface& input, const DelaunaySurface& refined) {
  const TriangleSurface& fine = refined.surface;
  ASSERT_EQ(refined.parent_face.size(), fine.triangles.size());
  const double length = bounding_box_diagonal(input);
  std::vector<double> covered(input.triangles.size(), 0.0);
  for (int f = 0; f < static_cast<int>(fine.triangles.size()); ++f) {
    const int parent = refined.parent_face[f];
    ASSERT_GE(parent, 0);
    ASSERT_LT(parent, static_cast<int>(input.triangles.size()));
    const auto& [a, b, c] = input.triangles[parent];
    for (const int v : fine.triangles[f]) {
      const Vec3 nearest = nearest_point_of_triangle(fine.points[v], input.points[a],
                                                     input.points[b], input.points[c]);
      ASSERT_LT((nearest - fine.points[v]).norm(), 1e-12 * length) << "vertex " << v;
      if (v >= static_cast<int>(input.points.size())) {
        ASSERT_LT(distance_to_outline(fine.points[v], input, parent), 1e-12 * length);
      }
    }
    ASSERT_GT(doubled_area_vector(fine, f).dot(doubled_area_vector(input, parent)), 0.0);
    covered[parent] += area(fine, f);
  }
  for (int f = 0; f < static_cast<int>(input.triangles.size()); ++f) {
    const auto& [a, b, c] = input.triangles[f];
    const Vec3 longest = (input.points[b] - input.points[a])
                             .cwiseAbs()
                             .cwiseMax((input.points[c] - input.points[b]).cwiseAbs());
    ASSERT_NEAR(covered[f], area(input, f), 1e-12 * longest.squaredNorm()) << "triangle " << f;
  }
  EXPECT_NEAR(total_area(fine), total_area(input), 1e-12 * total_area(input));
}

void expect_same_loops(const Connectivity& before, const Connectivity& after) {
  ASSERT_EQ(before.loops().size(), after.loops().size());
  for (std::size_t i = 0; i < before.loops().size(); ++i) {
    std::vector<int> a = before.loops()[i];
    std::vector<int> b = after.loops()[i];
    for (std::vector<int>* loop : {&a, &b}) {
      std::rotate(loop->begin(), std::min_element(loop->begin(), loop->end()), loop->end());
    }
    EXPECT_EQ(a, b) << "loop " << i;
  }
}

void expect_no_chords(const Connectivity& mesh) {
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const int h = mesh.halfedge(e);
    if (mesh.is_boundary_edge(e) || !mesh.is_boundary_vertex(mesh.tail(h))) continue;
    ASSERT_NE(mesh.loop_of_vertex(mesh.tail(h)), mesh.loop_of_vertex(mesh.tip(h)));
  }
}

void expect_delaunay_refinement(const TriangleSurface& input, const DelaunaySurface& refined) {
  EXPECT_EQ(refined.negative_edges, 0);
  ASSERT_EQ(refined.surface.points.size(), input.points.size() + refined.splits);
  for (std::size_t v = 0; v < input.points.size(); ++v) {
    ASSERT_EQ(refined.surface.points[v], input.points[v]);
  }
  const Connectivity before = connectivity_of(input);
  const Connectivity after = connectivity_of(refined.surface);  // throws if it is not a manifold
  EXPECT_EQ(after.euler_number(), before.euler_number());
  expect_same_loops(before, after);
  expect_no_chords(after);
  expect_no_negative_weights(refined.surface, after);
  expect_same_shape(input, refined);
}

class MakeDelaunay : public testing::TestWithParam<std::string> {};

INSTANTIATE_TEST_SUITE_P(All, MakeDelaunay, testing::ValuesIn(test::vessel_surface_names()),
                         [](const auto& param) { return test::alphanumeric(param.param); });

TEST_P(MakeDelaunay, RefinesWithoutChangingTheShape) {
  const TriangleSurface* input = test::vessel_surface(GetParam());
  if (input == nullptr) GTEST_SKIP() << "no shared data: " << GetParam();
  expect_delaunay_refinement(*input, test::delaunay_of(*input));
}

TEST_P(MakeDelaunay, LeavesItsOwnResultAlone) {
  const TriangleSurface* input = test::vessel_surface(GetParam());
  if (input == nullptr) GTEST_SKIP() << "no shared data: " << GetParam();
  const DelaunaySurface once = test::delaunay_of(*input);
  const DelaunaySurface twice = test::delaunay_of(once.surface);
  EXPECT_EQ(twice.splits, 0);
  EXPECT_EQ(twice.flips, 0);
  EXPECT_EQ(twice.surface.triangles, once.surface.triangles);
}

// One for each edge that is not Delaunay, and those that follow from it: had edges been split where
// flips would cross them, seven.
TEST(MakeDelaunayOfBadTriangles, TakesFewSplits) {
  const TriangleSurface* input = test::vessel_surface("carotid_jk_left.vtp");
  if (input == nullptr) GTEST_SKIP() << "no shared data: carotid_jk_left.vtp";
  const int not_delaunay = negative_weights(*input, connectivity_of(*input));
  EXPECT_LE(test::delaunay_of(*input).splits, 4 * not_delaunay);
}

TEST(MakeDelaunayOfBadTriangles, RefinesCrumpledTubes) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    for (const int n_along : {10, 20, 40}) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", " << n_along << " along");
      const TriangleSurface input = test::crumpled_tube(30, n_along, 8.0, seed, 0.3);
      const DelaunaySurface refined = test::delaunay_of(input);
      EXPECT_GT(refined.splits, 0);
      expect_delaunay_refinement(input, refined);
    }
  }
}

// Few vertices, all edges along the tube ten times as long as those around it.
TEST(MakeDelaunayOfBadTriangles, RefinesCoarseTubesOfLongTriangles) {
  const TriangleSurface input = test::crumpled_tube(30, 4, 8.0, 1, 0.03);
  const DelaunaySurface refined = test::delaunay_of(input);
  EXPECT_GT(refined.splits, 0);
  expect_delaunay_refinement(input, refined);
}

TEST(MakeDelaunayOfBadTriangles, CountsTheEdgesThatStayNegative) {
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U, 5U, 6U}) {
    SCOPED_TRACE(seed);
    const TriangleSurface input = test::crumpled_tube(30, 3, 15.0, seed, 0.1);
    const DelaunaySurface refined = test::delaunay_of(input);
    const Connectivity mesh = connectivity_of(refined.surface);
    EXPECT_EQ(refined.negative_edges, negative_weights(refined.surface, mesh));
    expect_same_shape(input, refined);
    expect_same_loops(connectivity_of(input), mesh);
  }
}

TEST(MakeDelaunayOfBadTriangles, DoesNotDependOnTheOrderForItsGuarantees) {
  const TriangleSurface input = test::crumpled_tube(24, 12, 9.0, 4, 0.1);
  for (const std::uint64_t seed : {11U, 12U}) {
    std::vector<int> order;
    const TriangleSurface mixed = test::shuffled(input, seed, order);
    expect_delaunay_refinement(mixed, test::delaunay_of(mixed));
  }
}

TEST(MakeDelaunayOfRegularGrids, KeepsCocircularNeighbours) {
  // Right triangles: every diagonal has the cotangent sum zero, up to rounding.
  const TriangleSurface grid = [] {
    TriangleSurface s;
    for (int j = 0; j < 8; ++j) {
      for (int i = 0; i < 12; ++i) {
        const double angle = 0.5235987755982988 * i;
        s.points.emplace_back(std::cos(angle), std::sin(angle), 0.3 * j);
      }
    }
    for (int j = 0; j < 7; ++j) {
      for (int i = 0; i < 12; ++i) {
        const int a = 12 * j + i;
        const int b = 12 * j + (i + 1) % 12;
        s.triangles.push_back({a, b, b + 12});
        s.triangles.push_back({a, b + 12, a + 12});
      }
    }
    return s;
  }();
  const DelaunaySurface refined = test::delaunay_of(grid);
  EXPECT_EQ(refined.splits, 0);
  EXPECT_EQ(refined.surface.triangles, grid.triangles);
}

TEST(MakeDelaunayAtLoops, SplitsChords) {
  TriangleSurface ring = annulus(1.0, 2.0, 12, 2);
  // Ears outside the outer loop: their base becomes a chord.
  const Connectivity mesh = connectivity_of(ring);
  int ears = 0;
  for (const std::vector<int>& loop : mesh.loops()) {
    if (ring.points[loop.front()].norm() < 1.5) continue;
    for (std::size_t i = 0; i < loop.size(); i += 3) {
      const int a = loop[i];
      const int b = loop[(i + 1) % loop.size()];
      ring.points.push_back(0.6 * (ring.points[a] + ring.points[b]));
      ring.triangles.push_back({b, a, static_cast<int>(ring.points.size()) - 1});
      ++ears;
    }
  }
  ASSERT_EQ(ears, 4);
  const DelaunaySurface refined = test::delaunay_of(ring);
  EXPECT_GE(refined.splits, ears);
  expect_delaunay_refinement(ring, refined);
}

}  // namespace
}  // namespace hexwall
