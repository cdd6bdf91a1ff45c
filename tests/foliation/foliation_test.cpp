#include "foliation/foliation.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "support/foliation_checks.h"

namespace hexwall {
namespace {

using test::Foliated;
using test::foliated;
using test::FoliationChecks;

class FoliationOfSurface : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    const TriangleSurface* surface = test::vessel_surface(GetParam());
    if (surface == nullptr) GTEST_SKIP() << "no shared data: " << GetParam();
    s_ = foliated(*surface);
  }

  Foliated s_;
};

INSTANTIATE_TEST_SUITE_P(All, FoliationOfSurface, testing::ValuesIn(test::vessel_surface_names()),
                         [](const auto& param) { return test::alphanumeric(param.param); });

TEST_P(FoliationOfSurface, ZerosCylindersAndStripsHaveTheRightNumbers) {
  const FoliationChecks checks(s_);
  checks.orders();
  checks.counts();
  checks.cylinder_tree();
}

TEST_P(FoliationOfSurface, CircumferencesAreThePeriods) {
  const FoliationChecks checks(s_);
  checks.circles();
  checks.flux();
}

TEST_P(FoliationOfSurface, XRisesAlongLevelCurves) {
  const FoliationChecks checks(s_);
  checks.arcs();
  checks.level_curves();
}

TEST_P(FoliationOfSurface, StripsFillTheCylinders) {
  for (const double width : s_.foliation.strips.width) EXPECT_GT(width, 0.0);
  FoliationChecks(s_).strips();
}

TEST_P(FoliationOfSurface, TwistsDoNotDependOnTheWayUp) {
  FoliationChecks(s_).labels();
}

TEST(FoliationOfCylinder, NeedsNoCorrection) {
  const Foliated s = foliated(cylinder(1.0, 6.0, 24, 25));
  ASSERT_EQ(s.foliation.cylinders.size(), 1U);
  EXPECT_EQ(s.foliation.corrected_arcs(), 0);
  EXPECT_TRUE(s.foliation.graph.zeros.empty());
  const Cylinder& c = s.foliation.cylinders.front();
  for (const double fraction : {0.01, 0.5, 0.77}) {
    const LevelCurve curve = level_curve(s.mesh(), s.form, c, c.y_bottom + fraction * c.height());
    EXPECT_FALSE(curve.corrected);
    // x is the angle: equal steps of x are equal steps around.
    const double turn = c.circumference();
    Vec3 last = point_at(s.h.surface(), s.mesh(), curve, curve.start()).position;
    for (int k = 1; k <= 12; ++k) {
      const SurfacePoint p =
          point_at(s.h.surface(), s.mesh(), curve, curve.start() + k * turn / 12.0);
      const double angle = std::remainder(
          std::atan2(p.position.y(), p.position.x()) - std::atan2(last.y(), last.x()),
          2.0 * std::acos(-1.0));
      EXPECT_NEAR(std::abs(angle), std::acos(-1.0) / 6.0, 2e-3);
      EXPECT_NEAR(p.position.z(), last.z(), 1e-12);
      last = p.position;
    }
  }
}

TEST(FoliationOfAnnulus, NeedsNoCorrection) {
  const Foliated s = foliated(*test::vessel_surface("annulus"));
  EXPECT_EQ(s.foliation.corrected_arcs(), 0);
}

TEST(FoliationWithHalfZeros, ARealStubHasThem) {
  const TriangleSurface* surface = test::vessel_surface("vampy_artery_test_small.stl");
  if (surface == nullptr) GTEST_SKIP() << "no shared data";
  const Foliated s = foliated(*surface);
  EXPECT_EQ(s.foliation.boundary_half_zeros(), 2);
  EXPECT_EQ(s.foliation.interior_zeros(), 0);
  EXPECT_EQ(s.foliation.strips.count(), 3);
  EXPECT_EQ(s.foliation.cylinders.size(), 2U);
}

// Without flux, the normal derivative of y changes its sign along the loop.
TEST(FoliationWithHalfZeros, ALoopWithoutFluxHasThem) {
  for (const int idle : {0, 1, 2}) {
    SCOPED_TRACE(idle);
    test::Harmonic h = test::harmonic(*test::vessel_surface("bifurcation"));
    Eigen::VectorXd periods(3);
    periods << 1.0, 1.0, 1.0;
    periods[idle] = 0.0;
    periods[(idle + 1) % 3] = -1.0;
    const Eigen::VectorXd lambda = periods.tail(2);
    ASSERT_EQ(h.basis.exterior, 0);
    const Foliated s = foliated(std::move(h), lambda);
    EXPECT_EQ(s.foliation.boundary_half_zeros(), 2);
    EXPECT_EQ(s.foliation.strips.count(), 3);
    EXPECT_EQ(s.foliation.cylinders.size(), 2U);
    for (const Zero& zero : s.foliation.graph.zeros) EXPECT_EQ(zero.loop, idle);
    FoliationChecks(s).all();
  }
}

TEST(FoliationOfAnyForm, IsValid) {
  const test::Harmonic h = test::harmonic(*test::vessel_surface("tree"));
  std::mt19937_64 random(9);
  int with_half_zeros = 0;
  for (int trial = 0; trial < 40; ++trial) {
    SCOPED_TRACE(trial);
    Eigen::VectorXd lambda(h.n());
    for (double& value : lambda) {
      value = static_cast<double>(random() >> 11) * 0x1.0p-53 - 0.5;
      if (trial % 4 == 0) value = std::round(4.0 * value);  // some loops without flux
    }
    lambda[0] += trial % 4 == 0 ? 1.0 : 0.0;
    const Foliated s = foliated(h, lambda);
    with_half_zeros += s.foliation.boundary_half_zeros() > 0 ? 1 : 0;
    FoliationChecks(s).all();
    if (testing::Test::HasFatalFailure()) return;
  }
  EXPECT_GT(with_half_zeros, 5);
}

TEST(FoliationOfAnyForm, TurnedUpsideDownHasTheSameCylinders) {
  const test::Harmonic h = test::harmonic(*test::vessel_surface("tree"));
  const Eigen::VectorXd lambda = test::optimum_of(h).lambda;
  const Foliated up = foliated(h, lambda);
  const Foliated down = foliated(h, -lambda);
  EXPECT_EQ(up.foliation.strips.count(), down.foliation.strips.count());
  std::vector<double> a;
  std::vector<double> b;
  for (const Cylinder& c : up.foliation.cylinders) a.push_back(c.circumference());
  for (const Cylinder& c : down.foliation.cylinders) b.push_back(c.circumference());
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-8 * a.back());
  std::vector<double> wide = up.foliation.strips.width;
  std::vector<double> turned = down.foliation.strips.width;
  std::sort(wide.begin(), wide.end());
  std::sort(turned.begin(), turned.end());
  for (std::size_t i = 0; i < wide.size(); ++i) EXPECT_NEAR(wide[i], turned[i], 1e-7 * a.back());
}

}  // namespace
}  // namespace hexwall
