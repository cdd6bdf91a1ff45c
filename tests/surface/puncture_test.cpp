#include "surface/puncture.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "surface/connectivity.h"
#include "surface/generate.h"

namespace hexwall {
namespace {

using std::numbers::pi;

// The triangle whose centroid is nearest to p.
SurfacePoint near(const TriangleSurface& surface, const Vec3& p) {
  SurfacePoint best;
  double least = 1e300;
  for (int f = 0; f < static_cast<int>(surface.triangles.size()); ++f) {
    const auto& [a, b, c] = surface.triangles[f];
    const Vec3 centroid = (surface.points[a] + surface.points[b] + surface.points[c]) / 3.0;
    if ((centroid - p).norm() >= least) continue;
    least = (centroid - p).norm();
    best = {f, centroid};
  }
  return best;
}

std::optional<PuncturedSurface> cut(const TriangleSurface& surface,
                                    const std::vector<SurfaceDisk>& disks) {
  return puncture(surface, connectivity_of(surface), disks);
}

// From triangles far larger than the disk to far smaller ones.
class Disk : public testing::TestWithParam<double> {};

TEST_P(Disk, IsRoundAndLeavesTheRestAsItWas) {
  const double radius = GetParam();
  const TriangleSurface surface = annulus(1.0, 2.0, 60, 7);
  const SurfacePoint center = near(surface, {0.0, 1.5, 0.0});
  const auto punctured = cut(surface, {{center, radius}});
  ASSERT_TRUE(punctured);
  const TriangleSurface& rest = punctured->surface;
  const Connectivity mesh = connectivity_of(rest);
  ASSERT_EQ(mesh.loops().size(), 3U);
  EXPECT_EQ(mesh.euler_number(), -1);
  const auto& loop = mesh.loops()[mesh.loop_of_vertex(punctured->hole_vertex.at(0))];
  EXPECT_GE(loop.size(), 16U);
  for (const int v : loop) {
    EXPECT_NEAR((rest.points[v] - center.position).norm(), radius, 0.03 * radius);
  }
  EXPECT_NEAR(total_area(surface) - total_area(rest), pi * radius * radius,
              0.03 * pi * radius * radius);
  double area = 0.0;
  for (int f = 0; f < static_cast<int>(rest.triangles.size()); ++f) {
    const Vec3 doubled = doubled_area_vector(rest, f);
    EXPECT_GT(doubled.z(), 0.0);
    area += 0.5 * doubled.norm();
    const SurfacePoint middle{punctured->parent_face[f], (rest.points[rest.triangles[f][0]] +
                                                          rest.points[rest.triangles[f][1]] +
                                                          rest.points[rest.triangles[f][2]]) /
                                                             3.0};
    EXPECT_GT(barycentric_coordinates(surface, middle).minCoeff(), 0.0);
  }
  EXPECT_NEAR(area, total_area(rest), 1e-12);
}

TEST_P(Disk, NamesTheTrianglesThatCoverIt) {
  const TriangleSurface surface = annulus(1.0, 2.0, 60, 7);
  const SurfacePoint center = near(surface, {0.0, 1.5, 0.0});
  const auto punctured = cut(surface, {{center, GetParam()}});
  ASSERT_TRUE(punctured);
  const auto& faces = punctured->disk_faces.at(0);
  const std::set<int> in_disk(faces.begin(), faces.end());
  double rest_of_them = 0.0;
  double area = 0.0;
  for (const int f : in_disk) area += 0.5 * doubled_area_vector(surface, f).norm();
  for (std::size_t f = 0; f < punctured->parent_face.size(); ++f) {
    if (in_disk.count(punctured->parent_face[f]) == 0) continue;
    rest_of_them += 0.5 * doubled_area_vector(punctured->surface, static_cast<int>(f)).norm();
  }
  const double cut_out = total_area(surface) - total_area(punctured->surface);
  EXPECT_NEAR(area - rest_of_them, cut_out, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Radius, Disk, testing::Values(0.005, 0.03, 0.1, 0.3, 0.33));

TEST(Puncture, KeepsVerticesAndLoopsOfTheSurface) {
  const TriangleSurface surface = cylinder(1.0, 6.0, 40, 30);
  const auto punctured = cut(surface, {{near(surface, {1.0, 0.0, 3.0}), 0.3}});
  ASSERT_TRUE(punctured);
  int kept = 0;
  for (std::size_t v = 0; v < punctured->original_vertex.size(); ++v) {
    const int u = punctured->original_vertex[v];
    if (u < 0) continue;
    ++kept;
    ASSERT_EQ(punctured->surface.points[v], surface.points[u]);
  }
  EXPECT_LT(kept, static_cast<int>(surface.points.size()));
  EXPECT_GT(kept, static_cast<int>(surface.points.size()) - 60);
}

TEST(Puncture, TakesSeveralDisks) {
  const TriangleSurface surface = cylinder(1.0, 6.0, 40, 30);
  const auto punctured =
      cut(surface, {{near(surface, {1.0, 0.0, 2.0}), 0.3}, {near(surface, {-1.0, 0.0, 4.0}), 0.4}});
  ASSERT_TRUE(punctured);
  const Connectivity mesh = connectivity_of(punctured->surface);
  EXPECT_EQ(mesh.loops().size(), 4U);
  EXPECT_EQ(mesh.euler_number(), -2);
  const int first = mesh.loop_of_vertex(punctured->hole_vertex.at(0));
  const int second = mesh.loop_of_vertex(punctured->hole_vertex.at(1));
  EXPECT_NE(first, second);
  for (const int v : mesh.loops()[second]) EXPECT_LT(punctured->surface.points[v].x(), 0.0);
}

TEST(Puncture, StaysOnTheSheetOfItsCentre) {
  // Two parallel planes' distance apart: the far wall of a thin tube lies within the radius.
  const TriangleSurface surface = cylinder(1.0, 6.0, 40, 30);
  const auto punctured = cut(surface, {{near(surface, {1.0, 0.0, 3.0}), 1.2}});
  ASSERT_TRUE(punctured);
  for (const Vec3& p : punctured->surface.points) {
    EXPECT_TRUE(p.x() < 0.5 || (p - Vec3(1.0, 0.0, 3.0)).norm() > 1.1);
  }
  EXPECT_EQ(connectivity_of(punctured->surface).loops().size(), 3U);
}

TEST(Puncture, RefusesWhatIsNoDisk) {
  const TriangleSurface surface = cylinder(1.0, 6.0, 40, 30);
  const SurfacePoint middle = near(surface, {1.0, 0.0, 3.0});
  EXPECT_TRUE(cut(surface, {{middle, 0.5}}));
  EXPECT_FALSE(cut(surface, {{middle, 2.1}})) << "a band around the tube";
  EXPECT_FALSE(cut(surface, {{middle, 3.5}})) << "reaches the ends";
  EXPECT_FALSE(cut(surface, {{near(surface, {1.0, 0.0, 0.2}), 0.5}})) << "reaches an end";
  EXPECT_FALSE(cut(surface, {{middle, 0.5}, {near(surface, {1.0, 0.0, 3.4}), 0.3}}))
      << "overlaps another one";
}

}  // namespace
}  // namespace hexwall
