#include "surface/repair.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "support/bad_surfaces.h"
#include "support/distance.h"
#include "support/expect_error.h"
#include "support/faults.h"
#include "support/vessel_surfaces.h"
#include "surface/check.h"
#include "surface/orient.h"
#include "surface/projector.h"
#include "surface/self_intersection.h"
#include "surface/surface_distance.h"

namespace hexwall {
namespace {

using test::expect_error;
using test::Fault;

/// Both stages, one after the other.
struct Repaired {
  RepairResult topology, geometry;

  const TriangleSurface& surface() const { return geometry.surface; }
  std::vector<RepairAction> actions() const {
    std::vector<RepairAction> all = topology.actions;
    all.insert(all.end(), geometry.actions.begin(), geometry.actions.end());
    return all;
  }
};

Repaired repaired(const TriangleSurface& surface, const RepairOptions& options = {}) {
  RepairResult topology = repair_topology(surface, options);
  RepairResult geometry = repair_geometry(topology.surface, options);
  return {std::move(topology), std::move(geometry)};
}

RepairOptions without(RepairStep step) {
  RepairOptions options;
  std::erase(options.steps, step);
  return options;
}

std::vector<RepairStep> steps_of(const std::vector<RepairAction>& actions) {
  std::vector<RepairStep> steps;
  for (const RepairAction& action : actions) steps.push_back(action.step);
  return steps;
}

void expect_same(const TriangleSurface& a, const TriangleSurface& b) {
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.triangles, b.triangles);
}

void expect_actions_of(const Fault& fault, const Repaired& result) {
  const std::vector<RepairAction> actions = result.actions();
  std::vector<RepairStep> expected = fault.before;
  expected.push_back(fault.step);
  ASSERT_EQ(steps_of(actions), expected);
  for (const RepairAction& action : actions) {
    EXPECT_EQ(action.count, action.step == fault.step ? fault.count : 1);
    EXPECT_EQ(static_cast<int>(action.places.size()), action.count);
    EXPECT_NE(action.text.find(coordinates(action.places[0])), std::string::npos);
  }
}

std::string fault_name(const testing::TestParamInfo<Fault>& info) {
  return info.param.name;
}

double worst_quality(const TriangleSurface& surface) {
  double worst = 1.0;
  for (const auto& [a, b, c] : surface.triangles) {
    worst = std::min(worst, quality(surface.points[a], surface.points[b], surface.points[c]));
  }
  return worst;
}

// --- every fault
// ----------------------------------------------------------------------------------

class AnyFault : public testing::TestWithParam<Fault> {};

TEST_P(AnyFault, IsRepairedByItsStepAlone) {
  const Repaired result = repaired(GetParam().surface);
  expect_actions_of(GetParam(), result);
  const CheckResult checked = check_surface(result.surface());
  EXPECT_EQ(checked.flipped, 0);
  EXPECT_EQ(connectivity_of(checked.surface).loops().size(), 2U);
  EXPECT_TRUE(result.geometry.is_free_of_intersections);
}

TEST_P(AnyFault, StaysIfItsStepIsSwitchedOff) {
  RepairOptions options = without(GetParam().step);
  for (const RepairStep step : GetParam().instead) std::erase(options.steps, step);
  // Triangles that are not welded would be refused as components.
  if (GetParam().name == "soup") std::erase(options.steps, RepairStep::components);
  const Repaired result = repaired(GetParam().surface, options);
  for (const RepairAction& action : result.actions()) EXPECT_NE(action.step, GetParam().step);
  // Faults may lead to others, but the one step alone mends them.
  EXPECT_FALSE(repaired(result.surface()).actions().empty());
}

TEST_P(AnyFault, IsGoneForGood) {
  const Repaired first = repaired(GetParam().surface);
  const Repaired second = repaired(first.surface());
  EXPECT_TRUE(second.actions().empty());
  EXPECT_EQ(second.geometry.moved, 0.0);
  expect_same(second.surface(), first.surface());
}

TEST_P(AnyFault, IsFoundInAnyPositionAndUnit) {
  const Repaired expected = repaired(GetParam().surface);
  for (const double scale : {1e-3, 1.0, 1e3}) {
    const Repaired result = repaired(test::transformed(GetParam().surface, [scale](const Vec3& p) {
      return Vec3(scale * test::rigid_motion(p));
    }));
    expect_actions_of(GetParam(), result);
    const std::size_t expected_count = expected.surface().triangles.size();
    if (GetParam().step == RepairStep::remesh) continue;  // rounding decides on its flips
    EXPECT_EQ(result.surface().triangles.size(), expected_count);
    EXPECT_NEAR(result.geometry.moved, scale * expected.geometry.moved, 1e-6 * scale);
  }
}

TEST_P(AnyFault, IsRepairedTheSameWayEachTime) {
  expect_same(repaired(GetParam().surface).surface(), repaired(GetParam().surface).surface());
}

std::vector<Fault> all_faults() {
  std::vector<Fault> faults = test::topology_faults();
  for (Fault& fault : test::geometry_faults()) faults.push_back(std::move(fault));
  return faults;
}

INSTANTIATE_TEST_SUITE_P(Repair, AnyFault, testing::ValuesIn(all_faults()), fault_name);

class FaultOfSeveralSteps : public testing::TestWithParam<Fault> {};

TEST_P(FaultOfSeveralSteps, IsRepairedByTheOthersIfItsStepIsSwitchedOff) {
  const Repaired result = repaired(GetParam().surface, without(GetParam().step));
  EXPECT_EQ(steps_of(result.actions()), GetParam().instead);
  const CheckResult checked = check_surface(result.surface());
  EXPECT_EQ(checked.flipped, 0);
  EXPECT_EQ(connectivity_of(checked.surface).loops().size(), 2U);
  EXPECT_LT(surface_distance(result.surface(), test::sound_tube()), 1e-12);
}

std::vector<Fault> faults_of_several_steps() {
  std::vector<Fault> faults = all_faults();
  std::erase_if(faults, [](const Fault& fault) { return fault.instead.empty(); });
  return faults;
}

INSTANTIATE_TEST_SUITE_P(Repair, FaultOfSeveralSteps, testing::ValuesIn(faults_of_several_steps()),
                         fault_name);

// --- topology
// -------------------------------------------------------------------------------------

class TopologyFault : public testing::TestWithParam<Fault> {};

/// Each triangle lies in the one it comes from, but for the distance over which points are merged.
TEST_P(TopologyFault, LeavesTrianglesInTheirOrigins) {
  const TriangleSurface& input = GetParam().surface;
  const RepairResult result = repair_topology(input);
  ASSERT_EQ(result.origin.size(), result.surface.triangles.size());
  for (int f = 0; f < static_cast<int>(result.origin.size()); ++f) {
    ASSERT_GE(result.origin[f], 0);
    const auto& [a, b, c] = input.triangles[result.origin[f]];
    const Vec3 p = centroid(result.surface, f);
    const Vec3 q = nearest_point_of_triangle(p, input.points[a], input.points[b], input.points[c]);
    EXPECT_LT((p - q).norm(), 1e-6 * bounding_box_diagonal(input));
  }
}

/// No hole, no fold, nothing twice: the area is that of the sound tube.
TEST_P(TopologyFault, LeavesTheSoundSurface) {
  const RepairResult result = repair_topology(GetParam().surface);
  const TriangleSurface sound =
      GetParam().name == "inner_wall" ? cylinder(1.0, 30.0, 12, 60) : test::sound_tube();
  EXPECT_NEAR(total_area(result.surface), total_area(sound), 1e-5 * total_area(sound));
  EXPECT_NEAR(signed_volume(result.surface), signed_volume(sound), 1e-3);
  // Of a doubled patch the larger one stays, with the other diagonal, which lies 2.9e-3 further in.
  const double limit = GetParam().name == "doubled_patch" ? 3e-3 : 1e-6;
  EXPECT_LT(surface_distance(result.surface, sound), limit);
}

INSTANTIATE_TEST_SUITE_P(Repair, TopologyFault, testing::ValuesIn(test::topology_faults()),
                         fault_name);

TEST(RepairTopology, GivesBackTheTubeItself) {
  for (const Fault& fault : test::topology_faults()) {
    const bool only_adds = fault.name == "fin" || fault.name == "strays" ||
                           fault.name == "repeated_triangles" || fault.name == "repeated_vertex" ||
                           fault.name == "turned_part";
    if (only_adds) expect_same(repair_topology(fault.surface).surface, test::sound_tube());
  }
}

TEST(RepairTopology, RunsStepAfterStep) {
  TriangleSurface surface;
  for (const Fault& fault : test::topology_faults()) {
    if (fault.name == "fin" || fault.name == "repeated_triangles") surface = fault.surface;
  }
  surface.triangles.push_back({5, 5, 6});
  test::append(surface, cylinder(0.02, 0.06, 5, 1), {3, 0, 0});
  std::swap(surface.triangles[70][0], surface.triangles[70][1]);
  EXPECT_EQ(steps_of(repair_topology(surface).actions),
            (std::vector{RepairStep::degenerate, RepairStep::nonmanifold, RepairStep::components,
                         RepairStep::orient}));
}

TEST(RepairTopology, RefusesLargeComponentsWithTheirSizesAndPlaces) {
  TriangleSurface surface = test::sound_tube();
  test::append(surface, cylinder(1.0, 1.0, 12, 3), {9, 0, 0});
  expect_error(
      ExitCode::topology,
      {"2 connected components", "2304 triangles, 75", "72 triangles, 24", "(9.", "delete"},
      [&] { repair_topology(surface); });
  RepairOptions options;
  options.small_component = 0.3;
  EXPECT_EQ(repair_topology(surface, options).actions.size(), 1U);
}

// All its components are small, but together they are the vessel: none may be kept alone.
TEST(RepairTopology, RefusesSurfacesThatAreNoneOfTheirComponents) {
  const TriangleSurface soup = test::topology_faults().front().surface;
  expect_error(ExitCode::topology, {"2304 connected components", "weld"},
               [&] { repair_topology(soup, without(RepairStep::weld)); });
}

/// A small octahedron that stands with a vertex on the tube, or with an edge.
TriangleSurface with_touching_octahedron(bool at_edge) {
  TriangleSurface surface = test::sound_tube();
  const auto& t = surface.triangles[1000];
  const int v = t[0];
  const int w = t[1];
  const Vec3 p = surface.points[v];
  const Vec3 out = 0.1 * Vec3(p.x(), p.y(), 0.0).normalized();
  const Vec3 along = surface.points[w] - p;
  const Vec3 side = out.cross(along).normalized() * 0.1;
  const int n = static_cast<int>(surface.points.size());
  for (const Vec3& q : {Vec3(p + out + side), Vec3(p + out - side), Vec3(p + 2.0 * out + along),
                        Vec3(p + 2.0 * out)}) {
    surface.points.push_back(q);
  }
  if (!at_edge) surface.points.emplace_back(p + along + 0.5 * out);
  const int u = at_edge ? w : n + 4;
  // Around the axis from n to n + 1: v, u, n + 2, n + 3.
  const std::array<int, 4> ring{v, u, n + 2, n + 3};
  for (int i = 0; i < 4; ++i) {
    surface.triangles.push_back({ring[i], ring[(i + 1) % 4], n});
    surface.triangles.push_back({ring[(i + 1) % 4], ring[i], n + 1});
  }
  return surface;
}

TEST(RepairTopology, TakesPartsThatTouchAway) {
  for (const bool at_edge : {false, true}) {
    const RepairResult result = repair_topology(with_touching_octahedron(at_edge));
    expect_same(result.surface, test::sound_tube());
  }
}

TEST(RepairTopology, SeparatesLargePartsThatTouchInAnEdge) {
  RepairOptions options = without(RepairStep::components);
  options.small_component = 1e-3;
  const RepairResult result = repair_topology(with_touching_octahedron(true), options);
  ASSERT_EQ(result.actions.size(), 1U);
  EXPECT_EQ(result.actions[0].count, 2);  // the two ends of the edge
  EXPECT_EQ(result.surface.points.size(), test::sound_tube().points.size() + 6);
  EXPECT_NO_THROW(connectivity_of(result.surface));
}

// A short branch and the wall inside it are both small: which of them is surplus is not clear.
TEST(RepairTopology, DoesNotGuessBetweenBranchAndInnerWall) {
  TriangleSurface surface = cylinder(1.0, 30.0, 12, 60);  // its first row of vertices is at the top
  const TriangleSurface branch = cylinder(1.0, 1.0, 12, 1);
  const int n = test::append(surface, branch, {0, 0, 30});
  for (auto& t : surface.triangles) {
    for (int& v : t) {
      if (v >= n + 12) v -= n + 12;  // the branch's lower row is the tube's upper one
    }
  }
  surface.points.resize(n + 13);
  surface.points.back() = Vec3(0, 0, 30);
  for (int i = 0; i < 12; ++i) surface.triangles.push_back({i, (i + 1) % 12, n + 12});
  EXPECT_TRUE(repair_topology(surface).actions.empty());
  expect_error(ExitCode::topology, {"12 edges have more than two"},
               [&] { check_surface(repaired(surface).surface()); });
}

TEST(RepairTopology, LeavesMoebiusBandsToTheCheck) {
  const TriangleSurface band = test::mobius_band();
  expect_same(repaired(band).surface(), band);
  expect_error(ExitCode::topology, {"Moebius"}, [&] { check_surface(repaired(band).surface()); });
}

TEST(RepairTopology, LeavesNonFiniteCoordinatesToTheCheck) {
  TriangleSurface surface = test::topology_faults().front().surface;
  surface.points[3].x() = std::numeric_limits<double>::quiet_NaN();
  const Repaired result = repaired(surface);
  EXPECT_TRUE(result.actions().empty());
  EXPECT_EQ(result.surface().triangles, surface.triangles);
  expect_error(ExitCode::geometry, {"not finite"}, [&] { check_surface(result.surface()); });
}

TEST(Repair, TakesEmptySurfaces) {
  EXPECT_TRUE(repaired({}).actions().empty());
}

// --- shape
// ----------------------------------------------------------------------------------------

class GeometryFault : public testing::TestWithParam<Fault> {};

/// `moved` against a second implementation, and within the tolerance.
TEST_P(GeometryFault, MovesAsFarAsItSaysAndNoFurther) {
  const TriangleSurface& input = GetParam().surface;
  const RepairResult result = repair_geometry(input);
  EXPECT_LE(result.moved, 0.5 * mean_edge_length(input));
  if (GetParam().step == RepairStep::pinholes) {
    EXPECT_EQ(result.moved, 0.0);
    return;
  }
  double farthest = 0.0;
  for (const auto& [from, to] : {std::pair(&input, &result.surface), {&result.surface, &input}}) {
    const test::SurfaceDistance distance(*to);
    for (int f = 0; f < static_cast<int>(from->triangles.size()); ++f) {
      farthest = std::max(farthest, distance(centroid(*from, f)).distance);
      for (const int v : from->triangles[f]) {
        farthest = std::max(farthest, distance(from->points[v]).distance);
      }
    }
  }
  EXPECT_NEAR(result.moved, farthest, 1e-9);
  EXPECT_GT(result.moved, 0.0);
}

/// Loops stay on their polylines, and none of their length is lost.
TEST_P(GeometryFault, KeepsLoops) {
  const TriangleSurface& input = GetParam().surface;
  const RepairResult result = repair_geometry(input);
  const Connectivity before = connectivity_of(input);
  const Connectivity after = connectivity_of(result.surface);
  std::vector<double> lengths = test::loop_lengths(result.surface, after);
  std::vector<double> former = test::loop_lengths(input, before);
  std::sort(lengths.rbegin(), lengths.rend());
  std::sort(former.rbegin(), former.rend());
  for (int i = 0; i < 2; ++i) EXPECT_NEAR(lengths[i], former[i], 1e-12 * former[i]);
  std::vector<std::vector<Vec3>> polylines;
  for (const auto& loop : before.loops()) {
    polylines.emplace_back();
    for (const int v : loop) polylines.back().push_back(input.points[v]);
  }
  for (const auto& loop : after.loops()) {
    for (const int v : loop) {
      double nearest = std::numeric_limits<double>::infinity();
      for (const auto& polyline : polylines) {
        nearest = std::min(nearest, test::distance_to_polyline(result.surface.points[v], polyline));
      }
      EXPECT_LT(nearest, 1e-12);
    }
  }
}

TEST_P(GeometryFault, ChangesNothingWithoutTolerance) {
  if (GetParam().step == RepairStep::pinholes) return;  // adds to the shape, moves nothing
  RepairOptions options;
  options.tolerance = 1e-9;
  const RepairResult result = repair_geometry(GetParam().surface, options);
  expect_same(result.surface, GetParam().surface);
  EXPECT_TRUE(result.actions.empty());
}

INSTANTIATE_TEST_SUITE_P(Repair, GeometryFault, testing::ValuesIn(test::geometry_faults()),
                         fault_name);

TriangleSurface geometry_fault(const std::string& name) {
  const std::vector<Fault> faults = test::geometry_faults();
  return std::find_if(faults.begin(), faults.end(), [&](const Fault& f) { return f.name == name; })
      ->surface;
}

TEST(RepairGeometry, MakesSliversAndLongTrianglesWellShaped) {
  const double tube = worst_quality(test::sound_tube());
  EXPECT_LT(worst_quality(geometry_fault("needle")), 0.01);
  // Which end of the needle stays is left open; it is 1e-3 of an edge long.
  EXPECT_NEAR(worst_quality(repair_geometry(geometry_fault("needle")).surface), tube, 1e-3);
  for (const char* name : {"cap", "cap_at_the_end"}) {
    EXPECT_LT(worst_quality(geometry_fault(name)), 0.01);
    EXPECT_GT(worst_quality(repair_geometry(geometry_fault(name)).surface), 0.3);
  }
  EXPECT_GT(worst_quality(repair_geometry(geometry_fault("long_triangles")).surface), 0.4);
}

TEST(RepairGeometry, FillsPinholesOnly) {
  const RepairResult result = repair_geometry(geometry_fault("pinholes"));
  EXPECT_EQ(std::count(result.origin.begin(), result.origin.end(), -1), 1 + 4);
  // The missing vertex stood out of its neighbours' plane: all else is as it was.
  EXPECT_NEAR(total_area(result.surface), total_area(test::sound_tube()), 1e-3);
  EXPECT_LT(surface_distance(result.surface, test::sound_tube()), 0.01);
}

TEST(RepairGeometry, FillsWhatIsAskedFor) {
  RepairOptions options;
  options.pinhole_length = 0.0;
  EXPECT_TRUE(repair_geometry(geometry_fault("pinholes"), options).actions.empty());
  options.pinhole_length = 0.5;  // the triangle, but not the six of a vertex
  EXPECT_EQ(repair_geometry(geometry_fault("pinholes"), options).actions.at(0).count, 1);
  options.pinhole_length = 7.0;  // more than 2 pi: both ends
  const TriangleSurface closed = repair_geometry(test::sound_tube(), options).surface;
  EXPECT_TRUE(connectivity_of(closed).loops().empty());
  EXPECT_NEAR(signed_volume(closed), signed_volume(test::sound_tube()), 1e-12);
}

// A branch as narrow as a hole of one vertex goes on as a tube: its end is no pinhole.
TEST(RepairGeometry, KeepsNarrowBranches) {
  TriangleSurface surface = test::sound_tube();
  const int v = surface.triangles[1152][0];
  const Connectivity mesh = connectivity_of(surface);
  std::vector<int> ring;
  for (int h = mesh.outgoing(v), first = h;;) {
    ring.push_back(mesh.tip(h));
    h = mesh.rotate(h);
    if (h == first) break;
  }
  std::erase_if(surface.triangles,
                [v](const auto& t) { return t[0] == v || t[1] == v || t[2] == v; });
  const int n = static_cast<int>(surface.points.size());
  const Vec3 out(0.4 * surface.points[v].x(), 0.4 * surface.points[v].y(), 0.0);
  const int count = static_cast<int>(ring.size());
  for (const int w : ring) surface.points.emplace_back(surface.points[w] + out);
  for (int i = 0; i < count; ++i) {
    const int next = (i + 1) % count;
    surface.triangles.push_back({ring[i], ring[next], n + i});
    surface.triangles.push_back({ring[next], n + next, n + i});
  }
  surface = check_surface(surface).surface;
  EXPECT_TRUE(repair_geometry(surface).actions.empty());
}

TEST(RepairGeometry, SeparatesFoldsAndLeavesWhatIsTooFarInside) {
  const TriangleSurface fold = geometry_fault("fold");
  const auto pairs = self_intersections(fold);
  EXPECT_FALSE(pairs.empty());
  const RepairResult result = repair_geometry(fold);
  EXPECT_TRUE(self_intersections(result.surface).empty());
  EXPECT_EQ(result.surface.triangles, fold.triangles);

  TriangleSurface crossing = test::sound_tube();
  for (int i = 0; i < 48; ++i) crossing.points[i] += Vec3(2.5, 0, -2.5);
  const RepairResult left = repair_geometry(crossing);
  EXPECT_FALSE(left.is_free_of_intersections);
  expect_error(ExitCode::geometry, {"self-intersection"}, [&] { check_surface(left.surface); });
}

TEST(RepairGeometry, RemeshesWithTheEdgeAskedFor) {
  RepairOptions options;
  options.remesh_edge = 0.2;
  const RepairResult result = repair_geometry(test::sound_tube(), options);
  ASSERT_EQ(result.actions.size(), 1U);
  EXPECT_EQ(result.actions[0].step, RepairStep::remesh);
  EXPECT_TRUE(std::all_of(result.origin.begin(), result.origin.end(), [](int f) { return f < 0; }));
  EXPECT_NEAR(total_area(result.surface), total_area(test::sound_tube()), 0.02 * 6 * 3.15);
  EXPECT_NEAR(mean_edge_length(result.surface), 0.2, 0.05);
  EXPECT_NO_THROW(check_surface(result.surface));
}

TEST(Repair, RefusesOptionsOutOfRange) {
  const auto expect_usage_error = [](const RepairOptions& options, const char* word) {
    expect_error(ExitCode::usage, {word}, [&] { repair_topology({}, options); });
    expect_error(ExitCode::usage, {word}, [&] { repair_geometry({}, options); });
  };
  RepairOptions options;
  options.tolerance = 0.0;
  expect_usage_error(options, "tolerance");
  options = {};
  options.pinhole_length = -1.0;
  expect_usage_error(options, "pinholes");
  options = {};
  options.small_component = 1.0;
  expect_usage_error(options, "components");
  options = {};
  options.remesh_edge = std::numeric_limits<double>::quiet_NaN();
  expect_usage_error(options, "edge length");
  options.remesh_edge = 1e-5;
  expect_error(ExitCode::usage, {"10 million"},
               [&] { repair_geometry(test::sound_tube(), options); });
}

TEST(Repair, NamesItsSteps) {
  for (const RepairStep step : all_repair_steps()) {
    EXPECT_EQ(repair_step_from_name(name(step)), step);
  }
  EXPECT_EQ(name(RepairStep::nonmanifold), "nonmanifold");
  expect_error(ExitCode::usage, {"'fins'", "weld", "pinholes", "intersections"},
               [] { repair_step_from_name("fins"); });
}

// --- anything
// -------------------------------------------------------------------------------------

TriangleSurface random_soup(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto below = [&random](std::uint64_t n) { return static_cast<int>(random() % n); };
  TriangleSurface soup;
  const int points = 4 + below(30);
  // Few different coordinates give many equal points and triangles without area.
  const int grid = 2 + below(5);
  for (int v = 0; v < points; ++v) {
    soup.points.emplace_back(below(grid), below(grid), below(grid));
    if (below(200) == 0) soup.points.back().x() = std::numeric_limits<double>::infinity();
    if (below(50) == 0) soup.points.back() *= 1e200;
    if (below(50) == 0) soup.points.back() *= 1e-200;
  }
  for (int f = below(60); f >= 0; --f) {
    soup.triangles.push_back({below(points), below(points), below(points)});
  }
  return soup;
}

TEST(Repair, EndsOnAnything) {
  int repaired_count = 0;
  int refused = 0;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    const TriangleSurface soup = random_soup(seed);
    RepairOptions options;
    if (seed % 2 == 0) std::erase(options.steps, RepairStep::components);
    try {
      const Repaired result = repaired(soup, options);
      repaired_count += result.actions().empty() ? 0 : 1;
      ASSERT_EQ(result.topology.origin.size(), result.topology.surface.triangles.size());
      for (const int f : result.topology.origin) {
        ASSERT_TRUE(f >= 0 && f < static_cast<int>(soup.triangles.size()));
      }
      const int n = static_cast<int>(result.surface().points.size());
      for (const auto& t : result.surface().triangles) {
        for (const int v : t) ASSERT_TRUE(v >= 0 && v < n);
      }
    } catch (const TopologyError&) {
      ++refused;
    }
  }
  EXPECT_GT(repaired_count, 500);
  EXPECT_GT(refused, 100);
}

/// A sound tube into which random faults are built: it must come out accepted or refused, never
/// worse.
TEST(Repair, EndsOnBatteredTubes) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    std::mt19937_64 random(seed);
    TriangleSurface surface = cylinder(1.0, 3.0, 16, 6);
    const auto any = [&random](std::size_t n) { return static_cast<int>(random() % n); };
    for (int i = 0; i < 8; ++i) {
      auto& t = surface.triangles[any(surface.triangles.size())];
      switch (any(6)) {
        case 0:
          std::swap(t[0], t[1]);
          break;
        case 1:
          surface.triangles.push_back({t[0], t[2], t[1]});
          break;
        case 2:
          surface.points[t[0]] = surface.points[t[1]];
          break;
        case 3:
          surface.points[t[0]] = 0.5 * (surface.points[t[1]] + surface.points[t[2]]);
          break;
        case 4:
          surface.triangles.erase(surface.triangles.begin() + any(192));
          break;
        default:
          t[0] = any(surface.points.size());
      }
    }
    try {
      const Repaired result = repaired(surface);
      check_surface(result.surface(), result.geometry.is_free_of_intersections);
      const Repaired again = repaired(result.surface());
      EXPECT_TRUE(again.actions().empty()) << seed << again.actions()[0].text;
    } catch (const Error& error) {
      EXPECT_TRUE(error.code() == ExitCode::topology || error.code() == ExitCode::geometry);
    }
  }
}

}  // namespace
}  // namespace hexwall
