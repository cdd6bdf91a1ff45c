#include "surface/clip.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>
#include <string>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "support/capped.h"
#include "support/expect_error.h"
#include "support/surfaces.h"
#include "support/temporary_folder.h"
#include "surface/check.h"
#include "surface/connectivity.h"
#include "surface/generate.h"
#include "surface/loop_shape.h"
#include "surface/open_surface.h"

namespace hexwall {
namespace {

using std::numbers::pi;
using test::expect_error;

CutPlane plane(const Vec3& point, const Vec3& normal) {
  return {point, normal.normalized(), {}, {}};
}

/// Smallest 2 r_in / R_circ of all triangles: 1 if they are equilateral.
double min_quality(const TriangleSurface& surface) {
  double least = 1.0;
  for (const auto& [a, b, c] : surface.triangles) {
    const Vec3 u = surface.points[b] - surface.points[a];
    const Vec3 v = surface.points[c] - surface.points[a];
    const double product = u.norm() * v.norm() * (u - v).norm();
    const double area = 0.5 * u.cross(v).norm();
    const double perimeter = u.norm() + v.norm() + (u - v).norm();
    least = std::min(least, 16.0 * area * area / (product * perimeter));
  }
  return least;
}

void expect_planar(const ClipResult& result, const CutPlane& cut) {
  const double scale = bounding_box_diagonal(result.surface) + cut.point.norm();
  for (const Vec3& p : points_of(result.surface, result.loop)) {
    EXPECT_LE(std::abs((p - cut.point).dot(cut.normal)), 1e-15 * scale);
  }
}

/// Loops and genus of a surface that must be a valid vessel wall.
int loop_count(const TriangleSurface& surface) {
  const CheckResult checked = check_surface(surface);
  return static_cast<int>(
      Connectivity(static_cast<int>(surface.points.size()), checked.surface.triangles)
          .loops()
          .size());
}

// --- cutting ------------------------------------------------------------------------------------

TEST(Clip, CutsACylinderExactly) {
  const TriangleSurface tube = cylinder(1.0, 5.0, 24, 22);
  const double edge = 2.0 * std::sin(pi / 24);
  for (const double z : {1.0, 2.345, 2.5, 3.99, 4.9}) {
    const CutPlane cut = plane({0, 0, z}, {0, 0, 1});
    const ClipResult result = clip(tube, cut);
    expect_planar(result, cut);
    EXPECT_EQ(loop_count(result.surface), 2);
    for (const Vec3& p : result.surface.points) EXPECT_LE(p.z(), z + 1e-14);
    // A tube of 24 flat sides, which vertices that slide along it leave by less than h² / 8 r.
    EXPECT_NEAR(total_area(result.surface), 24 * edge * z, 0.01 * 24 * edge * z);
    EXPECT_GT(min_quality(result.surface), 0.2) << z;
  }
}

TEST(Clip, KeepsWhatItDoesNotCut) {
  const TriangleSurface tube = cylinder(1.0, 5.0, 24, 22);
  const ClipResult result = clip(tube, plane({0, 0, 3.3}, {0.2, 0, 1}));
  ASSERT_EQ(result.origin.size(), result.surface.triangles.size());
  int whole = 0;
  for (std::size_t f = 0; f < result.origin.size(); ++f) {
    const auto& t = result.surface.triangles[f];
    const auto& old = tube.triangles[result.origin[f]];
    Vec3 normal = doubled_area_vector(result.surface, static_cast<int>(f)).normalized();
    EXPECT_GT(normal.dot(doubled_area_vector(tube, result.origin[f]).normalized()), 0.9);
    bool is_same = true;
    for (int k = 0; k < 3; ++k) {
      is_same = is_same && result.surface.points[t[k]] == tube.points[old[k]];
    }
    whole += is_same ? 1 : 0;
  }
  EXPECT_GT(whole, 24 * 2 * 12);  // all rows below the cut
}

TEST(Clip, CutsAtVerticesWithoutNewOnes) {
  const TriangleSurface tube = cylinder(1.0, 4.0, 16, 8);  // rings at every half
  const CutPlane cut = plane({0, 0, 2.5}, {0, 0, 1});
  const ClipResult result = clip(tube, cut);
  EXPECT_EQ(result.surface.points.size(), 16U * 6U);
  EXPECT_EQ(result.surface.triangles.size(), 16U * 2U * 5U);
  EXPECT_EQ(result.loop.size(), 16U);
  expect_planar(result, cut);
  // From the other side.
  const ClipResult other = clip(tube, plane({0, 0, 2.5}, {0, 0, -1}));
  EXPECT_EQ(other.surface.triangles.size(), 16U * 2U * 3U);
  EXPECT_NEAR(total_area(result.surface) + total_area(other.surface), total_area(tube), 1e-12);
}

TEST(Clip, TakesObliquePlanesInAnyPose) {
  const TriangleSurface tube = generate_shape(Shape::cylinder, 0.3);
  for (int i = 0; i < 12; ++i) {
    Eigen::Affine3d pose = Eigen::Affine3d::Identity();
    pose.translate(Vec3(100.0, -50.0, 3.0 * i));
    pose.rotate(Eigen::AngleAxisd(0.6 * i, Vec3(0.2 * i, 1.0, -0.4).normalized()));
    pose.scale(std::pow(10.0, i % 4 - 2));
    TriangleSurface moved = tube;
    for (Vec3& p : moved.points) p = pose * p;
    const double tilt = 0.1 * i;
    const CutPlane cut = plane(pose * Vec3(0.1, 0.2, 5.0 + 0.1 * i),
                               pose.linear() * Vec3(std::sin(tilt), 0.0, std::cos(tilt)));
    const ClipResult result = clip(moved, cut);
    expect_planar(result, cut);
    EXPECT_EQ(loop_count(result.surface), 2);
    EXPECT_GT(min_quality(result.surface), 0.1) << i;
    // The section of a cylinder is an ellipse of area pi / cos(tilt).
    const double scale = std::pow(10.0, i % 4 - 2);
    EXPECT_NEAR(loop_shape(points_of(result.surface, result.loop)).area / (scale * scale),
                pi / std::cos(tilt), 0.03 * pi / std::cos(tilt));
  }
}

TEST(Clip, LeavesOtherBranchesWhole) {
  const TriangleSurface vessel = generate_shape(Shape::bifurcation, 0.2);
  const Connectivity mesh = connectivity_of(vessel);
  for (const auto& loop : mesh.loops()) {
    const LoopShape end = loop_shape(points_of(vessel, loop));
    const Vec3 outward = -end.normal;
    const CutPlane cut = plane(end.center - end.radius * outward, outward);
    const ClipResult result = clip(vessel, cut);
    expect_planar(result, cut);
    EXPECT_EQ(loop_count(result.surface), 3);
    // A tube of one radius was removed.
    const double removed = total_area(vessel) - total_area(result.surface);
    EXPECT_NEAR(removed, end.length * end.radius, 0.1 * end.length * end.radius);
  }
}

TEST(Clip, LimitsTheCutToItsRadius) {
  const TriangleSurface vessel = generate_shape(Shape::bifurcation, 0.2);
  const Connectivity mesh = connectivity_of(vessel);
  const LoopShape end = loop_shape(points_of(vessel, mesh.loops()[0]));
  CutPlane cut = plane(end.center + end.radius * end.normal, -end.normal);
  cut.radius = 1.5 * end.radius;
  EXPECT_EQ(loop_count(clip(vessel, cut).surface), 3);
  cut.radius = 0.5 * end.radius;
  expect_error(ExitCode::geometry, {"within its radius"}, [&] { clip(vessel, cut); });
}

TEST(Clip, TakesTheSectionAroundThePointBeforeANearerOne) {
  // Two parallel tubes, a wide one and a thin one close to it, as one surface.
  TriangleSurface tubes = cylinder(1.0, 4.0, 32, 16);
  const int first = static_cast<int>(tubes.points.size());
  const TriangleSurface thin = cylinder(0.1, 4.0, 12, 40);
  for (const Vec3& p : thin.points) tubes.points.emplace_back(p + Vec3(1.15, 0, 0));
  for (const auto& [a, b, c] : thin.triangles) {
    tubes.triangles.push_back({a + first, b + first, c + first});
  }
  // The point lies in the wide tube, nearer to the thin one's section than most of its own.
  const ClipResult result = clip(tubes, plane({0.9, 0, 2.1}, {0, 0, 1}));
  EXPECT_NEAR(loop_shape(points_of(result.surface, result.loop)).radius, 1.0, 0.02);
  const ClipResult other = clip(tubes, plane({1.3, 0, 2.1}, {0, 0, 1}));
  EXPECT_NEAR(loop_shape(points_of(other.surface, other.loop)).radius, 0.1, 0.01);
}

class RealVessels : public testing::TestWithParam<std::string> {};

// Each end of each vessel is cut one radius from its loop, where the vessel lets one.
TEST_P(RealVessels, AreCutBeforeTheirEnds) {
  const auto surface = test::load_surface(GetParam());
  if (!surface) GTEST_SKIP() << "there is no file of " << GetParam();
  const TriangleSurface vessel = check_surface(*surface).surface;
  const Connectivity mesh = connectivity_of(vessel);
  for (const auto& loop : mesh.loops()) {
    const LoopShape end = loop_shape(points_of(vessel, loop));
    const CutPlane cut = plane(end.center + 0.73 * end.radius * end.normal, -end.normal);
    const ClipResult result = clip(vessel, cut);
    expect_planar(result, cut);
    EXPECT_EQ(loop_count(result.surface), static_cast<int>(mesh.loops().size()));
    EXPECT_GT(min_quality(result.surface), std::min(0.01, 0.1 * min_quality(vessel)));
  }
}

INSTANTIATE_TEST_SUITE_P(Clip, RealVessels,
                         testing::Values("aneurysm", "palabos_aneurysm_open.stl",
                                         "vmtk4an_ideal_aneurysm.stl", "vampy_case71_remeshed.vtp",
                                         "vampy_left_atrium_C35_flowext.vtp",
                                         "vasp_artery_flowext.vtp", "vascularmd_ideal_quads.vtk"),
                         test::test_name);

TEST(Clip, RefusesCutsThatCannotBeMade) {
  const TriangleSurface tube = cylinder(1.0, 5.0, 24, 22);
  expect_error(ExitCode::geometry, {"(0, 0, 9)", "misses the surface"}, [&] {
    clip(tube, plane({0, 0, 9}, {0, 0, 1}));
  });
  CutPlane lengthwise = plane({0.3, 0, 2}, {1, 0, 0});
  lengthwise.name = "outlet";
  expect_error(ExitCode::geometry, {"'outlet'", "runs into a boundary"},
               [&] { clip(tube, lengthwise); });
}

TEST(Clip, RefusesPointsFarFromTheSectionUnlessTheyHaveARadius) {
  const TriangleSurface tube = cylinder(1.0, 5.0, 24, 22);
  EXPECT_EQ(loop_count(clip(tube, plane({3.9, 0, 2.1}, {0, 0, 1})).surface), 2);
  CutPlane cut = plane({5.0, 0, 2.1}, {0, 0, 1});
  expect_error(ExitCode::geometry, {"(5, 0, 2.1)", "is 4", "away", "radius of 0.99"},
               [&] { clip(tube, cut); });
  cut.radius = 7.0;
  EXPECT_EQ(loop_count(clip(tube, cut).surface), 2);
}

TEST(Clip, RefusesCutsThatDoNotDivideTheSurface) {
  // A torus cut through its tube stays in one piece.
  TriangleSurface torus;
  const int n = 40;
  const int m = 16;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < m; ++j) {
      const double u = 2.0 * pi * i / n;
      const double r = 3.0 + std::cos(2.0 * pi * j / m);
      torus.points.emplace_back(r * std::cos(u), r * std::sin(u), std::sin(2.0 * pi * j / m));
      const int a = i * m + j;
      const int b = (i + 1) % n * m + j;
      const int c = (i + 1) % n * m + (j + 1) % m;
      torus.triangles.push_back({a, b, c});
      torus.triangles.push_back({a, c, i * m + (j + 1) % m});
    }
  }
  expect_error(ExitCode::geometry, {"does not divide"}, [&] {
    clip(torus, plane({3, 0.1, 0}, {0, 1, 0}));
  });
}

TEST(Clip, SurvivesBrokenSurfaces) {
  TriangleSurface broken = cylinder(1.0, 5.0, 24, 22);
  broken.triangles.push_back({0, 1, 300});  // a fin through the cut
  broken.triangles.push_back({5, 5, 300});
  broken.triangles.push_back(broken.triangles[500]);
  broken.points[30] = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  try {
    const ClipResult result = clip(broken, plane({0, 0, 2.6}, {0, 0, 1}));
    EXPECT_EQ(result.origin.size(), result.surface.triangles.size());
  } catch (const GeometryError& error) {
    EXPECT_NE(std::string(error.what()).find("the cut"), std::string::npos);
  }
}

TEST(OpenSurface, CutsFirstAndThenOpensTheRest) {
  const TriangleSurface closed = test::capped(cylinder(1.0, 5.0, 24, 22), test::CapStyle::wheel);
  OpenOptions options;
  options.cuts = {plane({0, 0, 4}, {0, 0.1, 1})};
  options.cuts[0].name = "outlet";
  const OpenResult result = open_surface(closed, {}, options);
  ASSERT_EQ(result.caps.size(), 2U);
  EXPECT_EQ(result.caps[0].name, "outlet");
  EXPECT_EQ(result.caps[0].how, "cut");
  EXPECT_GT(result.caps[0].normal.z(), 0.99);
  EXPECT_EQ(result.caps[1].how, "flat cap");
  EXPECT_EQ(loop_count(result.surface), 2);
  for (const int f : result.origin) EXPECT_LT(f, static_cast<int>(closed.triangles.size()) - 48);
}

TEST(OpenSurface, WarnsOfCutsThatRemoveMost) {
  OpenOptions options;
  options.cuts = {plane({0, 0, 4}, {0, 0, -1})};
  const OpenResult result = open_surface(cylinder(1.0, 5.0, 24, 22), {}, options);
  ASSERT_EQ(result.notes.size(), 2U);
  EXPECT_NE(result.notes[1].find("removed 80 %"), std::string::npos) << result.notes[1];
}

// --- files --------------------------------------------------------------------------------------

std::vector<CutPlane> read_text(const std::string& content) {
  const TemporaryFolder folder;
  std::ofstream(folder / "cuts.csv") << content;
  return read_cut_planes(folder / "cuts.csv");
}

void expect_refused(const std::string& content, std::initializer_list<const char*> words) {
  expect_error(ExitCode::read, words, [&] { read_text(content); });
}

TEST(CutPlanes, AreReadFromCommasAndBlanks) {
  const auto planes = read_text(
      "# x y z nx ny nz\n\n1 2 3 0 0 2\n1.5,-2,3e1, 3,0,4, 0.5, inlet\r\n0 0 0 1 0 0 out # end\n"
      "0\t0\t0\t1\t0\t0\t7\n");
  ASSERT_EQ(planes.size(), 4U);
  EXPECT_EQ(planes[0].point, Vec3(1, 2, 3));
  EXPECT_EQ(planes[0].normal, Vec3(0, 0, 1));
  EXPECT_FALSE(planes[0].radius);
  EXPECT_EQ(planes[1].point, Vec3(1.5, -2, 30));
  EXPECT_NEAR((planes[1].normal - Vec3(0.6, 0, 0.8)).norm(), 0.0, 1e-15);
  EXPECT_EQ(planes[1].radius, 0.5);
  EXPECT_EQ(planes[1].name, "inlet");
  EXPECT_EQ(planes[2].name, "out");
  EXPECT_EQ(planes[3].radius, 7.0);
}

TEST(CutPlanes, RefuseBadLinesWithTheirNumber) {
  expect_error(ExitCode::read, {"/nowhere/c.csv", "opened"},
               [] { read_cut_planes("/nowhere/c.csv"); });
  expect_refused("# nothing\n", {"cuts.csv", "no cut"});
  expect_refused("#\n0 0 0 1 0\n", {"line 2", "only 5"});
  expect_refused("x,y,z,nx,ny,nz\n0 0 0 1 0 0\n", {"line 1", "'x'"});
  expect_refused("0 0 0 1 0 inf\n", {"line 1", "'inf'"});
  expect_refused("0 0 0 0 0 0\n", {"line 1", "normal is 0"});
  expect_refused("0 0 0 1 0 0 -2\n", {"line 1", "positive"});
  expect_refused("0 0 0 1 0 0 2 in/let\n", {"line 1", "'in/let'"});
  expect_refused("0 0 0 1 0 0 2 inlet 5\n", {"line 1", "'5'"});
}

}  // namespace
}  // namespace hexwall
