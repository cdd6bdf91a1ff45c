#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "support/capped.h"
#include "support/expect_error.h"
#include "support/shared_data.h"
#include "support/surfaces.h"
#include "surface/check.h"
#include "surface/connectivity.h"
#include "surface/generate.h"
#include "surface/loop_shape.h"
#include "surface/open_surface.h"
#include "surface/read.h"

namespace hexwall {
namespace {

using std::numbers::pi;
using test::capped;
using test::CapStyle;
using test::expect_error;

TriangleSurface tube() {
  return cylinder(1.0, 5.0, 24, 12);
}

/// The tube with caps, and an array that is `wall` on the wall and counts from 1 on the caps.
struct LabelledTube {
  TriangleSurface surface = capped(tube(), CapStyle::rings);
  SurfaceArray array;
  LabelledTube(const std::string& name, double wall) : array{name, 1, {}} {
    const std::size_t wall_count = tube().triangles.size();
    const std::size_t cap_count = (surface.triangles.size() - wall_count) / 2;
    for (std::size_t f = 0; f < surface.triangles.size(); ++f) {
      const std::size_t cap = f < wall_count ? 0 : 1 + (f - wall_count) / cap_count;
      array.values.push_back(cap == 0 ? wall : static_cast<double>(cap));
    }
  }
};

TriangleSurface transformed(TriangleSurface surface, const Eigen::Affine3d& map) {
  for (Vec3& p : surface.points) p = map * p;
  return surface;
}

OpenOptions by_array(const std::string& name) {
  OpenOptions options;
  options.cap_array = name;
  return options;
}

// --- by shape -----------------------------------------------------------------------------------

class FlatCaps : public testing::TestWithParam<CapStyle> {};

TEST_P(FlatCaps, AreTakenOffWhateverTheirTrianglesAndNothingElse) {
  for (const Shape shape : {Shape::cylinder, Shape::bifurcation}) {
    const TriangleSurface open = generate_shape(shape, 0.25);
    const OpenResult result = open_surface(capped(open, GetParam()), {}, {});
    EXPECT_EQ(result.surface.points, open.points);
    EXPECT_EQ(result.surface.triangles, open.triangles);
    for (std::size_t f = 0; f < result.origin.size(); ++f) {
      EXPECT_EQ(result.origin[f], static_cast<int>(f));
    }
  }
}

TEST_P(FlatCaps, AreReportedWithTheirGeometry) {
  const int n = 24;
  const OpenResult result = open_surface(capped(tube(), GetParam()), {}, {});
  ASSERT_EQ(result.caps.size(), 2U);
  ASSERT_EQ(result.notes.size(), 2U);
  const double polygon_area = 0.5 * n * std::sin(2.0 * pi / n);
  double top = -1.0;
  for (const OpenedCap& cap : result.caps) {
    const double z = cap.center.z() > 2.5 ? 5.0 : 0.0;
    EXPECT_NEAR((cap.center - Vec3(0, 0, z)).norm(), 0.0, 1e-12);
    EXPECT_NEAR((cap.normal - Vec3(0, 0, z > 0.0 ? 1.0 : -1.0)).norm(), 0.0, 1e-12);
    EXPECT_NEAR(cap.area, polygon_area, 1e-12);
    EXPECT_NEAR(cap.radius, std::sqrt(polygon_area / pi), 1e-12);
    EXPECT_EQ(cap.how, "flat cap");
    top = std::max(top, z);
  }
  EXPECT_EQ(top, 5.0);
  EXPECT_NE(result.notes[0].find("radius 0.994"), std::string::npos) << result.notes[0];
}

TEST_P(FlatCaps, AreFoundInAnyPoseScaleAndWinding) {
  const TriangleSurface closed = capped(generate_shape(Shape::bifurcation, 0.25), GetParam());
  for (int i = 0; i < 8; ++i) {
    Eigen::Affine3d map = Eigen::Affine3d::Identity();
    map.translate(Vec3(3.0 * i, -7.0, 11.0));
    map.rotate(Eigen::AngleAxisd(0.7 * i, Vec3(1.0, 0.3 * i, -0.5).normalized()));
    map.scale(std::pow(10.0, i - 4));
    TriangleSurface moved = transformed(closed, map);
    for (std::size_t f = 0; f < moved.triangles.size(); f += 3) {
      std::swap(moved.triangles[f][0], moved.triangles[f][1]);
    }
    EXPECT_EQ(open_surface(moved, {}, {}).caps.size(), 3U) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(OpenSurface, FlatCaps,
                         testing::Values(CapStyle::fan, CapStyle::wheel, CapStyle::rings));

TEST(OpenSurface, OpensObliqueEnds) {
  TriangleSurface oblique = cylinder(1.0, 8.0, 24, 20);
  for (Vec3& p : oblique.points) p.z() *= 1.0 + 0.1 * p.x();  // the top is cut at 39°
  EXPECT_EQ(open_surface(capped(oblique, CapStyle::wheel), {}, {}).caps.size(), 2U);
}

TEST(OpenSurface, LeavesTheFlatOfADomeClosed) {
  // Half a sphere from its equator to 70°, where a disk closes it.
  TriangleSurface dome = cylinder(1.0, 1.0, 32, 24);
  for (Vec3& p : dome.points) {
    const double latitude = p.z() * 70.0 * pi / 180.0;
    p = std::cos(latitude) * Vec3(p.x(), p.y(), 0.0) + Vec3(0, 0, std::sin(latitude));
  }
  const OpenResult result = open_surface(capped(dome, CapStyle::wheel), {}, {});
  ASSERT_EQ(result.caps.size(), 1U);  // the end of the tube, not the flat of the dome
  EXPECT_NEAR(result.caps[0].normal.z(), -1.0, 1e-12);
}

TEST(OpenSurface, LeavesFacetsClosed) {
  // A box of squares, each face of 2 x 2 x 4 triangles: flat disks with sharp rims, side by side.
  TriangleSurface box = cylinder(1.0, std::sqrt(2.0), 4, 1);
  box = capped(box, CapStyle::fan);
  EXPECT_TRUE(open_surface(box, {}, {}).caps.empty());
  // A prism: its facets are long and thin, or touch one another.
  EXPECT_TRUE(open_surface(cylinder(1.0, 3.0, 6, 40), {}, {}).caps.empty());
}

TEST(OpenSurface, LooksForNothingUnlessAsked) {
  const TriangleSurface closed = capped(tube(), CapStyle::fan);
  OpenOptions options;
  options.automatic = false;
  const OpenResult result = open_surface(closed, {}, options);
  EXPECT_TRUE(result.caps.empty());
  EXPECT_EQ(result.surface.triangles, closed.triangles);
}

class OpenVessels : public testing::TestWithParam<std::string> {};

TEST_P(OpenVessels, StayAsTheyAre) {
  const auto surface = test::load_surface(GetParam());
  if (!surface) GTEST_SKIP() << "there is no file of " << GetParam();
  const OpenResult result = open_surface(*surface, {}, {});
  EXPECT_TRUE(result.caps.empty());
  EXPECT_EQ(result.surface.triangles, surface->triangles);
  EXPECT_EQ(result.surface.points, surface->points);
}

INSTANTIATE_TEST_SUITE_P(OpenSurface, OpenVessels, testing::ValuesIn(test::meshable_surfaces()),
                         test::test_name);

class CappedVessels : public testing::TestWithParam<std::string> {};

// Flat caps on real vessels whose ends are flat are found and taken off again.
TEST_P(CappedVessels, AreOpenedWhereTheyWere) {
  const auto surface = test::load_surface(GetParam());
  if (!surface) GTEST_SKIP() << "there is no file of " << GetParam();
  for (const CapStyle style : {CapStyle::fan, CapStyle::wheel, CapStyle::rings}) {
    const OpenResult result = open_surface(capped(*surface, style), {}, {});
    EXPECT_EQ(result.surface.triangles, surface->triangles);
  }
}

INSTANTIATE_TEST_SUITE_P(OpenSurface, CappedVessels,
                         testing::Values("palabos_aneurysm_open.stl", "vmtk4an_ideal_aneurysm.stl",
                                         "vasp_cylinder.vtp", "vascularmd_ideal_quads.vtk",
                                         "openlb_bifurcation3d.vtp"),
                         test::test_name);

// The rims of the aneurysm leave their planes by 3, 4 and 7 % of their radii: only the first is
// flat enough, and a fan over it is not, as its triangles are long.
TEST(OpenSurface, LeavesCapsOnUnevenRimsClosed) {
  const auto surface = test::load_surface("aneurysm");
  if (!surface) GTEST_SKIP() << "there is no file of the aneurysm";
  EXPECT_TRUE(open_surface(capped(*surface, CapStyle::fan), {}, {}).caps.empty());
  const Connectivity mesh = connectivity_of(*surface);
  ASSERT_EQ(mesh.loops().size(), 3U);
  const auto deviation = [&](const std::vector<int>& loop) {
    const LoopShape shape = loop_shape(points_of(*surface, loop));
    double largest = 0.0;
    for (const Vec3& p : points_of(*surface, loop)) {
      largest = std::max(largest, std::abs((p - shape.center).dot(shape.normal)) / shape.radius);
    }
    return largest;
  };
  const auto flattest =
      std::min_element(mesh.loops().begin(), mesh.loops().end(),
                       [&](const auto& a, const auto& b) { return deviation(a) < deviation(b); });
  for (const CapStyle style : {CapStyle::wheel, CapStyle::rings}) {
    const OpenResult result = open_surface(capped(*surface, style), {}, {});
    ASSERT_EQ(result.caps.size(), 1U);
    const Vec3 center = loop_shape(points_of(*surface, *flattest)).center;
    EXPECT_NEAR((result.caps[0].center - center).norm(), 0.0, 1e-9);
    EXPECT_TRUE(std::equal(surface->triangles.begin(), surface->triangles.end(),
                           result.surface.triangles.begin()));  // nothing of the wall is lost
  }
}

/// Centres of the loops of a checked surface.
std::vector<Vec3> loop_centers(const TriangleSurface& surface) {
  const CheckResult checked = check_surface(surface);
  const Connectivity mesh(static_cast<int>(surface.points.size()), checked.surface.triangles);
  std::vector<Vec3> centers;
  for (const auto& loop : mesh.loops()) {
    centers.push_back(loop_shape(points_of(checked.surface, loop)).center);
  }
  return centers;
}

TEST(OpenSurface, OpensTheBifurcationLikeItsOpenFile) {
  const auto closed = test::load_surface("openlb_bifurcation3d_closed.stl");
  const auto open = test::load_surface("openlb_bifurcation3d.vtp");
  if (!closed || !open) GTEST_SKIP() << "no shared data";
  const OpenResult result = open_surface(*closed, {}, {});
  EXPECT_EQ(result.surface.points.size(), open->points.size());
  EXPECT_EQ(result.surface.triangles.size(), open->triangles.size());
  const std::vector<Vec3> expected = loop_centers(*open);
  const std::vector<Vec3> centers = loop_centers(result.surface);
  ASSERT_EQ(centers.size(), 3U);
  for (const Vec3& c : expected) {
    EXPECT_TRUE(std::any_of(centers.begin(), centers.end(),
                            [&](const Vec3& d) { return (c - d).norm() < 1e-6; }));
  }
}

TEST(OpenSurface, OpensTheCoarseAorta) {
  const auto closed = test::load_surface("openlb_aorta3d_closed.stl");
  if (!closed) GTEST_SKIP() << "no shared data";
  const OpenResult result = open_surface(*closed, {}, {});
  ASSERT_EQ(result.caps.size(), 3U);
  EXPECT_EQ(loop_centers(result.surface).size(), 3U);
  for (const OpenedCap& cap : result.caps) EXPECT_NEAR(std::abs(cap.normal.y()), 1.0, 1e-3);
}

// --- by label -----------------------------------------------------------------------------------

TEST(OpenSurface, TakesPositiveDisksOfCapId) {
  const LabelledTube labelled("CapID", -1.0);
  const OpenResult result = open_surface(labelled.surface, {labelled.array}, {});
  EXPECT_EQ(result.surface.triangles, tube().triangles);
  ASSERT_EQ(result.caps.size(), 2U);
  EXPECT_EQ(result.caps[0].name, "CapID_1");
  EXPECT_EQ(result.caps[1].name, "CapID_2");
  EXPECT_EQ(result.caps[1].how, "array CapID = 2");
}

TEST(OpenSurface, TakesFlatDisksOfModelFaceIdAndCellEntityIds) {
  for (const char* name : {"ModelFaceID", "CellEntityIds"}) {
    const LabelledTube labelled(name, 7.0);
    const OpenResult result = open_surface(labelled.surface, {labelled.array}, {});
    EXPECT_EQ(result.surface.triangles, tube().triangles);
    ASSERT_EQ(result.caps.size(), 2U);
    EXPECT_EQ(result.caps[0].name, std::string(name) + "_1");
  }
}

TEST(OpenSurface, TakesNoBulgingOrOpenRegionForACap) {
  LabelledTube labelled("ModelFaceID", 7.0);
  labelled.surface.points.back().z() += 0.5 * (labelled.surface.points.back().z() > 1.0 ? 1 : -1);
  const OpenResult result = open_surface(labelled.surface, {labelled.array}, {});
  EXPECT_EQ(result.caps.size(), 1U);
  // Annuli: the same array on the open tube marks bands of the wall.
  TriangleSurface open = tube();
  SurfaceArray bands{"ModelFaceID", 1, {}};
  for (std::size_t f = 0; f < open.triangles.size(); ++f) {
    const std::size_t band = f / 96;
    bands.values.push_back(static_cast<double>(band));
  }
  EXPECT_TRUE(open_surface(open, {bands}, {}).caps.empty());
}

TEST(OpenSurface, NumbersSeparateRegionsOfOneValue) {
  LabelledTube labelled("ModelFaceID", 7.0);
  for (double& value : labelled.array.values) value = value == 7.0 ? 7.0 : 3.0;
  const OpenResult result = open_surface(labelled.surface, {labelled.array}, {});
  ASSERT_EQ(result.caps.size(), 2U);
  EXPECT_EQ(result.caps[0].name, "ModelFaceID_3");
  EXPECT_EQ(result.caps[1].name, "ModelFaceID_3_part2");
}

TEST(OpenSurface, FallsBackOnShapesWhereLabelsMarkNothing) {
  LabelledTube labelled("CellEntityIds", 0.0);
  std::fill(labelled.array.values.begin(), labelled.array.values.end(), 0.0);
  const OpenResult result = open_surface(labelled.surface, {labelled.array}, {});
  ASSERT_EQ(result.caps.size(), 2U);
  EXPECT_EQ(result.caps[0].how, "flat cap");
}

TEST(OpenSurface, TakesAllButTheLargestDisksOfANamedArray) {
  LabelledTube labelled("my lids", 0.0);
  labelled.surface.points.back().z() += 0.5;  // lids may bulge
  OpenOptions options = by_array("my lids");
  options.automatic = false;
  const OpenResult result = open_surface(labelled.surface, {labelled.array}, options);
  EXPECT_EQ(result.surface.triangles, tube().triangles);
  ASSERT_EQ(result.caps.size(), 2U);
  EXPECT_EQ(result.caps[0].name, "my_lids_1");
}

TEST(OpenSurface, RefusesNamedArraysThatAreMissingOrMarkNothing) {
  LabelledTube labelled("lids", 0.0);
  expect_error(ExitCode::usage, {"'caps'", "lids"},
               [&] { open_surface(labelled.surface, {labelled.array}, by_array("caps")); });
  expect_error(ExitCode::usage, {"'caps'", "none"},
               [&] { open_surface(labelled.surface, {}, by_array("caps")); });
  std::fill(labelled.array.values.begin(), labelled.array.values.end(), 4.0);
  expect_error(ExitCode::usage, {"'lids'", "marks no caps"},
               [&] { open_surface(labelled.surface, {labelled.array}, by_array("lids")); });
}

TEST(OpenSurface, RefusesToRemoveEverything) {
  const TriangleSurface closed = capped(tube(), CapStyle::wheel);
  SurfaceArray array{"CapID", 1, {}};
  const std::size_t last_cap = closed.triangles.size() - 24;
  for (std::size_t f = 0; f < closed.triangles.size(); ++f) {
    array.values.push_back(f < last_cap ? 1.0 : 2.0);
  }
  expect_error(ExitCode::geometry, {"nothing is left"}, [&] { open_surface(closed, {array}, {}); });
}

// --- broken input -------------------------------------------------------------------------------

TEST(OpenSurface, SurvivesBrokenSurfaces) {
  TriangleSurface broken = capped(tube(), CapStyle::wheel);
  broken.triangles.push_back({0, 1, 30});  // a fin
  broken.triangles.push_back({5, 5, 6});
  broken.triangles.push_back({7, 7, 7});
  broken.triangles.push_back(broken.triangles[40]);
  broken.points[100] = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  const OpenResult result = open_surface(broken, {}, {});
  EXPECT_EQ(result.origin.size(), result.surface.triangles.size());
  EXPECT_GE(result.caps.size(), 1U);  // the far end is whole
  EXPECT_TRUE(open_surface({}, {}, {}).caps.empty());
}

TEST(OpenSurface, SurvivesBrokenFiles) {
  for (const char* name : {"carotid_jk_left.stl", "matteo_AAA_phantom.stl"}) {
    const auto surface = test::load_surface(name);
    if (!surface) GTEST_SKIP() << "no shared data";
    EXPECT_TRUE(open_surface(*surface, {}, {}).caps.empty()) << name;
  }
}

TEST(OpenSurface, ArraysFollowARepairByItsOrigin) {
  // A repair that drops triangles and turns the order around.
  const LabelledTube labelled("CapID", 0.0);
  TriangleSurface repaired = labelled.surface;
  std::vector<int> origin;
  for (int f = static_cast<int>(repaired.triangles.size()); f-- > 0;) origin.push_back(f);
  for (std::size_t f = 0; f < origin.size(); ++f) {
    repaired.triangles[f] = labelled.surface.triangles[origin[f]];
  }
  const OpenResult result = open_surface(repaired, {follow(labelled.array, origin)}, {});
  EXPECT_EQ(result.caps.size(), 2U);
  EXPECT_EQ(result.surface.triangles.size(), tube().triangles.size());
}

}  // namespace
}  // namespace hexwall
