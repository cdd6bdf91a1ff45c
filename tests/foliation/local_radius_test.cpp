#include "foliation/local_radius.h"

#include <cmath>

#include <gtest/gtest.h>

#include "holomorphic/solution.h"
#include "surface/generate.h"

namespace hexwall {
namespace {

std::vector<double> radii_of(const TriangleSurface& surface) {
  const Connectivity mesh = connectivity_of(surface);
  const Eigen::VectorXd edge = Eigen::VectorXd::Ones(mesh.face_count());
  const auto s = solve_form({surface, mesh, edge});
  return local_radius(s.refined.surface, s.connectivity, s.form, foliate(s.connectivity, s.form),
                      s.first_pole());
}

TEST(LocalRadius, OfACylinderIsItsRadius) {
  const TriangleSurface surface = cylinder(2.5, 12.0, 64, 30);
  for (const double radius : radii_of(surface)) EXPECT_NEAR(radius, 2.5, 0.01);
}

TEST(LocalRadius, FollowsACone) {
  TriangleSurface surface = cylinder(1.0, 12.0, 64, 120);
  for (Vec3& p : surface.points) {
    const double scale = 1.0 + 0.1 * p.z();
    p = Vec3(scale * p.x(), scale * p.y(), p.z());
  }
  const std::vector<double> radii = radii_of(surface);
  for (std::size_t v = 0; v < surface.points.size(); ++v) {
    const double z = surface.points[v].z();
    if (z < 3.0 || z > 9.0) continue;  // smoothing flattens the ends
    EXPECT_NEAR(radii[v], 1.0 + 0.1 * z, 0.05);
  }
}

TEST(LocalRadius, ScalesWithTheSurface) {
  TriangleSurface surface = generate_shape(Shape::bifurcation);
  const std::vector<double> radii = radii_of(surface);
  for (Vec3& p : surface.points) p *= 1000.0;
  const std::vector<double> scaled = radii_of(surface);
  ASSERT_EQ(radii.size(), scaled.size());
  for (std::size_t v = 0; v < radii.size(); ++v) {
    EXPECT_NEAR(scaled[v], 1000.0 * radii[v], 1e-3 * scaled[v]);
  }
}

}  // namespace
}  // namespace hexwall
