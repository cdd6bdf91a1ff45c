#include "holomorphic/form.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "support/harmonic_forms.h"

namespace hexwall {
namespace {

using std::numbers::pi;
using test::Harmonic;
using test::harmonic;

Eigen::VectorXd some_periods(int n) {
  Eigen::VectorXd lambda(n);
  for (int i = 0; i < n; ++i) lambda[i] = 1.0 + 0.7 * i - (i % 3 == 1 ? 4.0 : 0.0);
  return lambda;
}

TEST(Combine, KeepsLoopsOnOneLevelBitwise) {
  const Harmonic h = harmonic(*test::vessel_surface("tree"), 3);
  const HolomorphicForm form = h.form(some_periods(h.n()));
  for (const std::vector<int>& loop : h.mesh.loops()) {
    for (const int v : loop) ASSERT_EQ(form.y[v], form.y[loop.front()]);
  }
}

TEST(Combine, GivesTheFormThePeriodsAskedFor) {
  const Harmonic h = harmonic(*test::vessel_surface("tree"), 3);
  const Eigen::VectorXd lambda = some_periods(h.n());
  const HolomorphicForm form = h.form(lambda);
  ASSERT_EQ(form.periods.size(), h.n() + 1);
  EXPECT_NEAR(form.periods.sum(), 0.0, 1e-12);
  for (int i = 0; i < h.n(); ++i) EXPECT_EQ(form.periods[h.basis.loop(i)], lambda[i]);
  for (int loop = 0; loop <= h.n(); ++loop) {
    EXPECT_NEAR(period(h.mesh, form.dx, loop), form.periods[loop], 1e-9);
  }
}

TEST(Combine, IsTheSumOfThePotentials) {
  const Harmonic h = harmonic(*test::vessel_surface("bifurcation"));
  const Eigen::VectorXd lambda = some_periods(h.n());
  const HolomorphicForm form = h.form(lambda);
  EXPECT_LT((h.g * lambda - form.y).cwiseAbs().maxCoeff(), 1e-12);
}

// The flux of grad y into the surface at each loop is the period of x.
TEST(Combine, FluxOfYIsThePeriodOfX) {
  const Harmonic h = harmonic(*test::vessel_surface("tree"));
  const HolomorphicForm form = h.form(some_periods(h.n()));
  const Eigen::SparseMatrix<double> derivative = d0(h.mesh);
  // Green's formula: the sum of (L y) over the vertices of a loop is the flux out through it.
  const Eigen::VectorXd outflow =
      derivative.transpose() * (h.star.asDiagonal() * (derivative * form.y));
  for (int loop = 0; loop <= h.n(); ++loop) {
    double flux = 0.0;
    for (const int v : h.mesh.loops()[loop]) flux -= outflow[v];
    EXPECT_NEAR(flux, form.periods[loop], 1e-9);
  }
}

// One right-hand side gives what the sum of all basis forms gives, and the two energies, of x by
// the periods and of y by the potentials, enclose the area of the image.
TEST(Combine, IsTheSumOfThePeriodicForms) {
  const Harmonic h = harmonic(*test::vessel_surface("tree"), 2);
  const Eigen::VectorXd lambda = some_periods(h.n());
  const HolomorphicForm form = h.form(lambda);
  const Eigen::VectorXd sum = h.periodic.omega * lambda;
  EXPECT_LT((sum - form.dx.values).cwiseAbs().maxCoeff(), 1e-10 * sum.cwiseAbs().maxCoeff());
  const double by_periods = lambda.dot(h.periodic.gram * lambda);
  const double by_potentials = lambda.dot(h.basis.capacity.llt().solve(lambda));
  EXPECT_NEAR(form.error, by_periods / by_potentials - 1.0, 1e-9);
  EXPECT_GT(form.error, 0.0);
  EXPECT_LT(form.error, h.n() * h.periodic.error);
}

TEST(CombineOnAnnulus, TheErrorShrinksWithSecondOrder) {
  std::vector<double> errors;
  for (int k = 1; k <= 8; k *= 2) {
    const Harmonic h = harmonic(annulus(1.0, 2.0, 24 * k, 3 * k));
    errors.push_back(h.form(Eigen::VectorXd::Constant(1, 1.7)).error);
  }
  for (std::size_t i = 1; i < errors.size(); ++i) {
    EXPECT_NEAR(std::log2(errors[i - 1] / errors[i]), 2.0, 0.2);
  }
}

TEST(CombineOnCylinder, IsTheDevelopmentOfTheTube) {
  const int n_around = 24;
  const double length = 6.0;
  const TriangleSurface tube = cylinder(1.0, length, n_around, 25);
  for (const double lambda : {2.0 * pi, -3.0}) {
    const Harmonic h = harmonic(tube);
    const HolomorphicForm form = h.form(Eigen::VectorXd::Constant(1, lambda));
    const std::vector<int>& loop = h.mesh.loops()[h.basis.loop(0)];
    // With the surface on the left, the walk around the loop is along +angle at the lower end.
    const bool lower = tube.points[loop.front()].z() < 0.5 * length;
    const double scale = (lower ? 1.0 : -1.0) * lambda / (2.0 * pi);
    const double perimeter = 2.0 * n_around * std::sin(pi / n_around);
    const double slant = std::hypot(length / 25, 1.0 - std::cos(pi / n_around));
    const double dy_dz = scale * 2.0 * pi * (slant * 25 / length) / perimeter;
    for (int e = 0; e < h.mesh.edge_count(); ++e) {
      const Vec3& p = tube.points[h.mesh.tail(h.mesh.halfedge(e))];
      const Vec3& q = tube.points[h.mesh.tip(h.mesh.halfedge(e))];
      const double angle =
          std::remainder(std::atan2(q.y(), q.x()) - std::atan2(p.y(), p.x()), 2.0 * pi);
      ASSERT_NEAR(form.dx.values[e], scale * angle, 1e-11);
      const double dy =
          form.y[h.mesh.tip(h.mesh.halfedge(e))] - form.y[h.mesh.tail(h.mesh.halfedge(e))];
      ASSERT_NEAR(dy, dy_dz * (q.z() - p.z()), 1e-11);
    }
    EXPECT_LT(cauchy_riemann_defect(h, form), 1e-11);
  }
}

TEST(CombineOnAnnulus, CauchyRiemannHoldsToFirstOrder) {
  std::vector<double> defects;
  for (int k = 1; k <= 8; k *= 2) {
    const Harmonic h = harmonic(annulus(1.0, 2.0, 24 * k, 3 * k));
    const HolomorphicForm form = h.form(Eigen::VectorXd::Constant(1, 1.7));
    defects.push_back(cauchy_riemann_defect(h, form));
  }
  EXPECT_LT(defects.front(), 0.2);
  for (std::size_t i = 1; i < defects.size(); ++i) {
    EXPECT_NEAR(std::log2(defects[i - 1] / defects[i]), 1.0, 0.2);
  }
}

// y = log r and x = angle, up to scale.
TEST(CombineOnAnnulus, IsTheLogarithm) {
  const TriangleSurface surface = annulus(1.0, 2.0, 192, 24);
  const Harmonic h = harmonic(surface);
  const HolomorphicForm form = h.form(Eigen::VectorXd::Constant(1, 2.0 * pi));
  const bool inner = surface.points[h.mesh.loops()[h.basis.loop(0)].front()].norm() < 1.5;
  // Walking around the inner circle with the surface on the left is clockwise: y rises outward.
  const double sign = inner ? 1.0 : -1.0;
  const double y_inner = form.y[h.mesh.loops()[inner ? h.basis.loop(0) : h.basis.exterior].front()];
  for (int v = 0; v < h.mesh.vertex_count(); ++v) {
    ASSERT_NEAR(form.y[v] - y_inner, sign * std::log(surface.points[v].norm()), 2e-4);
  }
  for (int e = 0; e < h.mesh.edge_count(); ++e) {
    const Vec3& p = surface.points[h.mesh.tail(h.mesh.halfedge(e))];
    const Vec3& q = surface.points[h.mesh.tip(h.mesh.halfedge(e))];
    const double angle =
        std::remainder(std::atan2(q.y(), q.x()) - std::atan2(p.y(), p.x()), 2.0 * pi);
    ASSERT_NEAR(form.dx.values[e], -sign * angle, 1e-4);
  }
}

TEST(CombineOnVessels, CauchyRiemannHoldsUpToDiscretisation) {
  std::vector<double> defects;
  for (const double edge : {0.4, 0.2, 0.1}) {
    const Harmonic h = harmonic(generate_shape(Shape::bifurcation, edge));
    defects.push_back(cauchy_riemann_defect(h, h.form(some_periods(h.n()))));
  }
  EXPECT_LT(defects[0], 0.3);
  EXPECT_LT(defects[1], 0.7 * defects[0]);
  EXPECT_LT(defects[2], 0.7 * defects[1]);
}

}  // namespace
}  // namespace hexwall
