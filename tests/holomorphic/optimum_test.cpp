#include "holomorphic/optimum.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "support/harmonic_forms.h"

namespace hexwall {
namespace {

using test::Harmonic;
using test::harmonic;
using test::optimum_of;

// Signed circumferences of all loops.
std::vector<double> periods_of(const Harmonic& h, const Eigen::VectorXd& lambda) {
  std::vector<double> periods(h.n() + 1, -lambda.sum());
  for (int i = 0; i < h.n(); ++i) periods[h.basis.loop(i)] = lambda[i];
  return periods;
}

// A surface that `make_delaunay` leaves alone, so that variants of it are refined alike.
TriangleSurface delaunay_surface(const std::string& name) {
  return test::delaunay_of(*test::vessel_surface(name)).surface;
}

class Optimum : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    const TriangleSurface* surface = test::vessel_surface(GetParam());
    if (surface == nullptr) GTEST_SKIP() << "no shared data: " << GetParam();
    h_ = harmonic(*surface);
    energy_ = test::energy_of(h_);
    result_ = optimum_of(h_);
  }

  Harmonic h_;
  std::unique_ptr<AreaEnergy> energy_;
  OptimumResult result_;
};

INSTANTIATE_TEST_SUITE_P(Some, Optimum,
                         testing::Values("annulus", "cylinder", "bifurcation", "tree",
                                         "palabos_aneurysm_open.stl", "vampy_left_atrium.vtp",
                                         "vascularmd_ideal_quads.vtk"),
                         [](const auto& param) { return test::alphanumeric(param.param); });

TEST_P(Optimum, DescentsNeverRise) {
  for (const Descent& descent : result_.descents) {
    ASSERT_FALSE(descent.iterations.empty());
    EXPECT_TRUE(std::is_sorted(descent.iterations.rbegin(), descent.iterations.rend()));
    EXPECT_EQ(descent.iterations.back(), descent.energy);
    EXPECT_NEAR(energy_->value(descent.lambda), descent.energy, 1e-12);
  }
}

TEST_P(Optimum, EveryDescentEndsAtAMinimum) {
  for (const Descent& descent : result_.descents) {
    Eigen::VectorXd gradient;
    Eigen::MatrixXd hessian;
    energy_->derivatives(descent.lambda, gradient, hessian);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(hessian);
    const double largest = eigen.eigenvalues().cwiseAbs().maxCoeff();
    EXPECT_GT(eigen.eigenvalues().minCoeff(), -1e-8 * largest);
    // The energy that a Newton step could still gain.
    EXPECT_LT(gradient.squaredNorm() / largest, 1e-11);
  }
}

TEST_P(Optimum, IsTheLeastOfAllDescents) {
  ASSERT_GE(result_.best, 0);
  ASSERT_LT(result_.best, static_cast<int>(result_.descents.size()));
  // Every pattern but all signs equal, up to a common sign.
  EXPECT_EQ(result_.descents.size(), (1U << h_.n()) - 1U);
  for (const Descent& descent : result_.descents) EXPECT_LE(result_.energy, descent.energy);
  EXPECT_EQ(result_.descents[result_.best].energy, result_.energy);
  EXPECT_NEAR(energy_->value(result_.lambda), result_.energy, 1e-12);
}

TEST_P(Optimum, TheGreatestCircumferenceIsPositive) {
  const std::vector<double> periods = periods_of(h_, result_.lambda);
  const auto [least, greatest] = std::minmax_element(periods.begin(), periods.end());
  EXPECT_GE(*greatest, -*least * (1.0 - 1e-8));
}

TEST(OptimumOfCylinder, IsTheDevelopment) {
  const Harmonic h = harmonic(cylinder(1.0, 6.0, 24, 25));
  const OptimumResult result = optimum_of(h);
  EXPECT_NEAR(result.lambda[0], 48.0 * std::sin(std::numbers::pi / 24.0), 1e-5);
  EXPECT_NEAR(result.energy, 0.0, 1e-11);
}

TEST(OptimumInvariance, AnyLoopMayBeTheExterior) {
  const TriangleSurface surface = delaunay_surface("bifurcation");
  const Harmonic first = harmonic(surface, 0);
  const OptimumResult expected = optimum_of(first);
  for (const int exterior : {1, 2}) {
    const Harmonic h = harmonic(surface, exterior);
    const OptimumResult result = optimum_of(h);
    EXPECT_NEAR(result.energy, expected.energy, 1e-9 * expected.energy);
    const std::vector<double> a = periods_of(first, expected.lambda);
    const std::vector<double> b = periods_of(h, result.lambda);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(b[i], a[i], 1e-4 * std::abs(a[i]));
  }
}

TEST(OptimumInvariance, AnyLoopOfManyMayBeTheExterior) {
  const TriangleSurface surface = delaunay_surface("tree");
  const double expected = optimum_of(harmonic(surface, 0)).energy;
  for (const int exterior : {3, 6}) {
    EXPECT_NEAR(optimum_of(harmonic(surface, exterior)).energy, expected, 1e-8 * expected);
  }
}

TEST(OptimumInvariance, TheOrderOfVerticesAndTrianglesDoesNotMatter) {
  const TriangleSurface surface = delaunay_surface("bifurcation");
  const double expected = optimum_of(harmonic(surface)).energy;
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    std::vector<int> order;
    const Harmonic h = harmonic(test::shuffled(surface, seed, order));
    ASSERT_EQ(h.refined.splits, 0);
    EXPECT_NEAR(optimum_of(h).energy, expected, 1e-8 * expected);
  }
}

TEST(OptimumInvariance, ARigidMotionDoesNotMatter) {
  const TriangleSurface surface = delaunay_surface("bifurcation");
  const OptimumResult expected = optimum_of(harmonic(surface));
  const Harmonic h = harmonic(test::transformed(surface, test::rigid_motion));
  ASSERT_EQ(h.refined.splits, 0);
  const OptimumResult result = optimum_of(h);
  EXPECT_NEAR(result.energy, expected.energy, 1e-8 * expected.energy);
  EXPECT_LT((result.lambda - expected.lambda).norm(), 1e-6 * expected.lambda.norm());
}

TEST(OptimumInvariance, CircumferencesScaleWithTheSurface) {
  const TriangleSurface surface = delaunay_surface("bifurcation");
  const OptimumResult expected = optimum_of(harmonic(surface));
  for (const double scale : {1e-3, 1e3}) {
    const Harmonic h =
        harmonic(test::transformed(surface, [&](const Vec3& p) -> Vec3 { return scale * p; }));
    ASSERT_EQ(h.refined.splits, 0);
    const OptimumResult result = optimum_of(h);
    EXPECT_NEAR(result.energy, expected.energy, 1e-8 * expected.energy);
    EXPECT_LT((result.lambda / scale - expected.lambda).norm(), 1e-5 * expected.lambda.norm());
  }
}

TEST(OptimumSearch, FlippingSignsFindsWhatTryingAllDoes) {
  for (const char* name : {"bifurcation", "tree"}) {
    SCOPED_TRACE(name);
    const Harmonic h = harmonic(*test::vessel_surface(name));
    const OptimumResult exhaustive = optimum_of(h);
    const OptimumResult searched = test::searched_optimum_of(h);
    EXPECT_NEAR(searched.energy, exhaustive.energy, 1e-10);
    EXPECT_LT((searched.lambda - exhaustive.lambda).norm(), 1e-3 * exhaustive.lambda.norm());
    for (const Descent& descent : searched.descents) EXPECT_LE(searched.energy, descent.energy);
  }
}

TEST(OptimumSearch, IsReproducible) {
  const Harmonic h = harmonic(*test::vessel_surface("bifurcation"));
  const OptimumResult once = test::searched_optimum_of(h);
  const OptimumResult again = test::searched_optimum_of(h);
  EXPECT_EQ(once.lambda, again.lambda);
  EXPECT_EQ(once.descents.size(), again.descents.size());
}

TEST(Descend, GivesUpWhatIsHopeless) {
  const Harmonic h = harmonic(*test::vessel_surface("tree"));
  const auto energy = test::energy_of(h);
  const Eigen::VectorXd start = Eigen::VectorXd::LinSpaced(h.n(), 20.0, -20.0);
  const Descent whole = descend(*energy, start, 200);
  const Eigen::VectorXd near = 1.1 * whole.lambda;
  const Descent hopeful = descend(*energy, near, 200, 1.01 * whole.energy);
  EXPECT_NEAR(hopeful.energy, whole.energy, 1e-9);
  const Descent hopeless = descend(*energy, start, 200, 0.5 * whole.energy);
  EXPECT_LT(hopeless.iterations.size(), whole.iterations.size());
}

TEST(Descend, StopsAtTheLimitOfIterations) {
  const Harmonic h = harmonic(*test::vessel_surface("tree"));
  const auto energy = test::energy_of(h);
  const Eigen::VectorXd start = Eigen::VectorXd::LinSpaced(h.n(), 20.0, -20.0);
  const Descent none = descend(*energy, start, 0);
  EXPECT_EQ(none.lambda, start);
  EXPECT_EQ(none.iterations.size(), 1U);
  EXPECT_EQ(none.iterations.front(), energy->value(start));
  const Descent two = descend(*energy, start, 2);
  EXPECT_LE(two.iterations.size(), 3U);
  EXPECT_LT(two.energy, none.energy);
}

}  // namespace
}  // namespace hexwall
