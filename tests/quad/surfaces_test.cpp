// The quad mesh of every surface that can be meshed: topology, place and numbers, judged by code
// that the pipeline does not use.

#include "support/surfaces.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "pipeline.h"
#include "support/distance.h"
#include "support/mesh_verifier.h"
#include "surface/generate.h"

namespace hexwall::test {
namespace {

/// The zeros of the form are where its poly-annulus wants them: twice the order of each is the
/// surplus of quads over a regular vertex, times two at interior and times one at boundary zeros.
/// Each pole has four corners of valence 3.
void expect_valences(const PipelineResult& r, const QuadVerdict& verdict) {
  int doubled_interior_order = 0;
  int halves = 0;
  int corners = 0;
  int irregular = 0;
  for (std::size_t v = 0; v < verdict.valence.size(); ++v) {
    const int valence = verdict.valence[v];
    if (verdict.on_boundary[v] != 0) {
      EXPECT_TRUE(valence == 3 || (valence >= 5 && valence % 2 == 1))
          << "boundary vertex " << v << " of valence " << valence;
      halves += (valence - 3) / 2;
      continue;
    }
    irregular += valence != 4 ? 1 : 0;
    if (valence == 3) {
      ++corners;
    } else {
      EXPECT_TRUE(valence == 4 || (valence >= 8 && valence % 4 == 0))
          << "vertex " << v << " of valence " << valence;
      doubled_interior_order += valence / 2 - 2;
    }
  }
  const int loops = static_cast<int>(r.openings.size() + r.poles.size());
  EXPECT_EQ(corners, 4 * static_cast<int>(r.poles.size()));
  EXPECT_EQ(doubled_interior_order, 2 * r.foliation.interior_zeros());
  EXPECT_EQ(halves, r.foliation.boundary_half_zeros());
  EXPECT_EQ(doubled_interior_order + halves, 2 * (loops - 2));
  EXPECT_EQ(irregular, r.quad_quality.irregular);
}

void expect_topology(const PipelineResult& r) {
  const int vertex_count = static_cast<int>(r.quads.points.size());
  const int loops = static_cast<int>(r.openings.size());
  const QuadVerdict verdict = verify_quads(vertex_count, r.quads.quads);
  EXPECT_TRUE(verdict.faults.none()) << verdict.faults.text();
  EXPECT_EQ(verdict.components, 1);
  EXPECT_EQ(verdict.boundary_loops, loops);
  EXPECT_EQ(verdict.euler_number, 2 - loops);
  for (int v = 0; v < vertex_count; ++v) {
    ASSERT_EQ(verdict.on_boundary[v] != 0, r.quads.loop_of_vertex[v] >= 0) << "vertex " << v;
  }
  expect_valences(r, verdict);
}

void expect_on_surface(const PipelineResult& r) {
  const double tolerance = 1e-6 * bounding_box_diagonal(r.surface);
  const SurfaceDistance distance(r.surface);
  double greatest = 0.0;
  for (const Vec3& p : r.quads.points) greatest = std::max(greatest, distance(p).distance);
  EXPECT_LE(greatest, tolerance);
}

/// The quads look out where the surface does: judged by area, since a quad across a sharp crease,
/// or one that alone covers a blind sac, may look elsewhere.
void expect_outward(const PipelineResult& r) {
  const SurfaceDistance distance(r.surface);
  double area = 0.0;
  double inward = 0.0;
  for (const auto& q : r.quads.quads) {
    const std::vector<Vec3>& p = r.quads.points;
    const Vec3 normal = 0.5 * (p[q[2]] - p[q[0]]).cross(p[q[3]] - p[q[1]]);
    const Vec3 center = 0.25 * (p[q[0]] + p[q[1]] + p[q[2]] + p[q[3]]);
    const auto& t = r.surface.triangles[distance(center).triangle];
    const std::vector<Vec3>& s = r.surface.points;
    area += normal.norm();
    if ((s[t[1]] - s[t[0]]).cross(s[t[2]] - s[t[0]]).dot(normal) <= 0.0) inward += normal.norm();
  }
  EXPECT_LE(inward, 5e-3 * area);
  EXPECT_NEAR(area / total_area(r.surface), 0.98, 0.03);
}

/// Boundary vertices lie on the polyline of their loop, and every loop is covered all around.
void expect_loops(const PipelineResult& r) {
  const double tolerance = 1e-6 * bounding_box_diagonal(r.surface);
  for (int loop = 0; loop < static_cast<int>(r.openings.size()); ++loop) {
    std::vector<Vec3> polyline;
    double length = 0.0;
    for (const int v : r.connectivity.loops()[loop]) polyline.push_back(r.surface.points[v]);
    for (std::size_t i = 0; i < polyline.size(); ++i) {
      length += (polyline[(i + 1) % polyline.size()] - polyline[i]).norm();
    }
    int count = 0;
    double greatest = 0.0;
    for (std::size_t v = 0; v < r.quads.points.size(); ++v) {
      if (r.quads.loop_of_vertex[v] != loop) continue;
      ++count;
      greatest = std::max(greatest, distance_to_polyline(r.quads.points[v], polyline));
    }
    EXPECT_LE(greatest, tolerance) << r.openings[loop].name;
    EXPECT_GE(count, 8) << r.openings[loop].name;
    EXPECT_NEAR(r.openings[loop].length, length, 1e-9 * length);
  }
}

double percentile(const std::vector<double>& sorted, double fraction) {
  return sorted[std::lround(fraction * static_cast<double>(sorted.size() - 1))];
}

void expect_reported_lengths(const PipelineResult& r) {
  std::set<std::pair<int, int>> edges;
  for (const auto& quad : r.quads.quads) {
    for (int k = 0; k < 4; ++k) edges.insert(std::minmax({quad[k], quad[(k + 1) % 4]}));
  }
  std::vector<double> lengths;
  for (const auto& [a, b] : edges) {
    lengths.push_back((r.quads.points[a] - r.quads.points[b]).norm() /
                      (0.5 * (r.target_edge[a] + r.target_edge[b])));
  }
  std::sort(lengths.begin(), lengths.end());
  const auto& reported = r.quad_quality.edge_length_quantiles;
  const std::array<double, 5> fractions{0.01, 0.05, 0.5, 0.95, 0.99};
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(reported[i], percentile(lengths, fractions[i]), 1e-9);
  EXPECT_NEAR(reported[2], 1.0, 0.5);
  // Corners may be right on edges of no length, but cells on them are slivers.
  EXPECT_GE(lengths.front(), 0.01);
}

/// The numbers in the report are those of the mesh in the files.
void expect_reported_quality(const PipelineResult& r) {
  double squares = 0.0;
  double least = 1.0;
  double area = 0.0;
  double off_area = 0.0;
  for (const auto& quad : r.quads.quads) {
    std::array<Vec3, 4> p;
    for (int k = 0; k < 4; ++k) p[k] = r.quads.points[quad[k]];
    const Vec3 normal = (p[1] - p[0]).cross(p[2] - p[0]) + (p[2] - p[0]).cross(p[3] - p[0]);
    for (int k = 0; k < 4; ++k) {
      const Vec3 u = (p[(k + 1) % 4] - p[k]).normalized();
      const Vec3 v = (p[(k + 3) % 4] - p[k]).normalized();
      squares +=
          std::pow(std::acos(std::clamp(u.dot(v), -1.0, 1.0)) * 180.0 / std::numbers::pi - 90.0, 2);
      least = std::min(least, u.cross(v).dot(normal.normalized()));
    }
    const double side = std::sqrt(0.5 * normal.norm()) / *r.options.size;
    area += normal.norm();
    if (side < 0.5 || side > 2.0) off_area += normal.norm();
  }
  const double corners = 4.0 * static_cast<double>(r.quads.quads.size());
  EXPECT_NEAR(r.quad_quality.angle_stddev_deg, std::sqrt(squares / corners), 1e-6);
  EXPECT_NEAR(r.quad_quality.min_scaled_jacobian, least, 1e-9);
  EXPECT_NEAR(r.quad_quality.off_size_area_fraction, off_area / area, 1e-9);
  EXPECT_GT(least, 0.0);
}

/// Every strip and every cylinder has its quads, and every circle has at least 8.
void expect_quantisation(const PipelineResult& r) {
  for (const int count : r.numbers.across) EXPECT_GE(count, 1);
  for (const int count : r.numbers.along) EXPECT_GE(count, 1);
  ASSERT_EQ(r.numbers.along.size(), r.foliation.cylinders.size());
  std::vector<long> quads_of_cylinder(r.numbers.along.size(), 0);
  for (const int cylinder : r.quads.cylinder) {
    if (cylinder >= 0) ++quads_of_cylinder[cylinder];
  }
  for (std::size_t c = 0; c < quads_of_cylinder.size(); ++c) {
    const int around = r.numbers.around(r.foliation.strips, static_cast<int>(c));
    EXPECT_GE(around, 8) << "cylinder " << c;
    EXPECT_EQ(quads_of_cylinder[c], static_cast<long>(around) * r.numbers.along[c]);
  }
  long in_caps = 0;
  ASSERT_EQ(r.pole_caps.size(), r.poles.size());
  for (const PoleCap& cap : r.pole_caps) {
    EXPECT_EQ(cap.around % 4, 0);
    in_caps += static_cast<long>(cap.around / 4) * (cap.around / 4);
  }
  EXPECT_EQ(r.numbers.quad_count(r.foliation.strips) + in_caps,
            static_cast<long>(r.quads.quads.size()));
}

class QuadsOfSurface : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    surface_ = load_surface(GetParam());
    if (!surface_) GTEST_SKIP() << GetParam() << " is not on this machine";
  }
  std::optional<TriangleSurface> surface_;
};

TEST_P(QuadsOfSurface, AreConformingOnTheSurfaceAndAsReported) {
  const PipelineResult r = run_pipeline(*surface_, {});
  expect_topology(r);
  expect_on_surface(r);
  expect_outward(r);
  expect_loops(r);
  expect_reported_quality(r);
  expect_reported_lengths(r);
  expect_quantisation(r);
}

/// The pure form: zeros alone, whatever that does to the sizes.
TEST_P(QuadsOfSurface, HaveZerosAloneWithoutPoles) {
  PipelineOptions options;
  options.poles.mode = PoleRequest::Mode::off;
  const PipelineResult r = run_pipeline(*surface_, options);
  EXPECT_TRUE(r.poles.empty());
  expect_topology(r);
  expect_on_surface(r);
  expect_quantisation(r);
}

INSTANTIATE_TEST_SUITE_P(, QuadsOfSurface, testing::ValuesIn(meshable_surfaces()), test_name);

/// What poles are for: even quads on blind sacs, with few irregular vertices.
class Sacs : public testing::TestWithParam<std::string> {};

TEST_P(Sacs, AreMeshedEvenly) {
  const auto surface = load_surface(GetParam());
  if (!surface) GTEST_SKIP() << GetParam() << " is not on this machine";
  const PipelineResult r = run_pipeline(*surface, {});
  EXPECT_GE(r.poles.size(), 1U);
  EXPECT_LE(r.poles.size(), 3U);
  EXPECT_GE(r.poles.front().off_share_before, 0.25);
  EXPECT_LE(r.solution.off_size_share, 0.06);
  EXPECT_LE(r.quad_quality.off_size_area_fraction, 0.06);
  EXPECT_GE(r.quad_quality.min_scaled_jacobian, 0.4);
  EXPECT_GT(r.min_wall_scaled_jacobian, 0.0);
  // The pole's own fields rise or fall all around its loop.
  for (const Zero& zero : r.foliation.graph.zeros) EXPECT_FALSE(r.solution.is_pole(zero.loop));
}

INSTANTIATE_TEST_SUITE_P(, Sacs,
                         testing::Values("aneurysm", "palabos_aneurysm_open.stl",
                                         "vmtk4an_ideal_aneurysm.stl"),
                         test_name);

/// Coarse and fine: strips narrower than a quad and circles of few quads come up here.
class QuadsOfSize : public testing::TestWithParam<double> {};

TEST_P(QuadsOfSize, KeepTheTopologyOfABifurcation) {
  const TriangleSurface surface = generate_shape(Shape::bifurcation);
  PipelineOptions options;
  options.size = GetParam();
  const PipelineResult r = run_pipeline(surface, options);
  expect_topology(r);
  expect_on_surface(r);
  expect_loops(r);
  expect_quantisation(r);
}

INSTANTIATE_TEST_SUITE_P(, QuadsOfSize, testing::Values(0.05, 0.2, 0.5, 1.0, 3.0));

}  // namespace
}  // namespace hexwall::test
