// Developed flow on the faces of an opening, against Poiseuille's and Womersley's solutions.

#include "flow/cross_section.h"

#include <cmath>
#include <complex>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "support/cell_tube.h"
#include "support/expect_error.h"
#include "support/womersley.h"

namespace hexwall {
namespace {

using Complex = std::complex<double>;

CellTube ellipse(int across, bool triangles) {
  CellTube tube;
  tube.across = across;
  tube.rings = across / 2;
  tube.radius_x = 3.0;
  tube.radius_y = 2.0;
  tube.triangles = triangles;
  return tube;
}

CellTube circle(int across, bool triangles) {
  CellTube tube = ellipse(across, triangles);
  tube.radius_x = tube.radius_y = 2.0;
  return tube;
}

/// Mean of |difference to 2 (1 - x²/a² - y²/b²)|, by area. The exact mean over a face differs from
/// the value at its centre by the second order that is measured.
double steady_error(const CellTube& tube) {
  const CellDisc disc = cross_section(tube);
  const CrossSection section(disc.points, disc.faces);
  const std::vector<double> u = section.steady();
  double sum = 0.0;
  for (std::size_t f = 0; f < u.size(); ++f) {
    const Vec3 c = section.face_centers()[f];
    const double exact =
        2.0 * (1.0 - std::pow(c.x() / tube.radius_x, 2) - std::pow(c.y() / tube.radius_y, 2));
    sum += std::abs(u[f] - exact) * section.face_areas()[f];
  }
  return sum / section.area();
}

double womersley_error(const CellTube& tube, double omega_over_nu) {
  const CellDisc disc = cross_section(tube);
  const CrossSection section(disc.points, disc.faces);
  const std::vector<Complex> u = section.oscillating(omega_over_nu);
  const Womersley exact{tube.radius_x, omega_over_nu};
  double sum = 0.0;
  for (std::size_t f = 0; f < u.size(); ++f) {
    const double r = section.face_centers()[f].norm();
    sum += std::abs(u[f] - exact.velocity(r)) * section.face_areas()[f];
  }
  return sum / section.area();
}

double order(double coarse, double fine) {
  return std::log2(coarse / fine);
}

TEST(CrossSection, PoiseuilleInACircleConvergesWithSecondOrder) {
  for (const bool triangles : {false, true}) {
    const double coarse = steady_error(circle(8, triangles));
    const double fine = steady_error(circle(16, triangles));
    EXPECT_GT(order(coarse, fine), 1.8) << coarse << ' ' << fine;
    EXPECT_LT(fine, 0.01);
  }
}

TEST(CrossSection, PoiseuilleInAnEllipseConvergesWithSecondOrder) {
  for (const bool triangles : {false, true}) {
    const double coarse = steady_error(ellipse(8, triangles));
    const double fine = steady_error(ellipse(16, triangles));
    EXPECT_GT(order(coarse, fine), 1.8) << coarse << ' ' << fine;
    EXPECT_LT(fine, 0.01);
  }
}

TEST(CrossSection, WomersleyInACircleConvergesWithSecondOrder) {
  // Womersley number R sqrt(ω/ν) = 6.
  const double omega_over_nu = 9.0;
  const double coarse = womersley_error(circle(8, true), omega_over_nu);
  const double fine = womersley_error(circle(16, true), omega_over_nu);
  EXPECT_GT(order(coarse, fine), 1.8) << coarse << ' ' << fine;
  EXPECT_LT(fine, 0.015);
}

TEST(CrossSection, SlowOscillationIsSteadyFlow) {
  const CellDisc disc = cross_section(circle(6, true));
  const CrossSection section(disc.points, disc.faces);
  const std::vector<double> steady = section.steady();
  const std::vector<Complex> slow = section.oscillating(0.0);
  for (std::size_t f = 0; f < steady.size(); ++f)
    EXPECT_NEAR(std::abs(slow[f] - steady[f]), 0.0, 1e-12);
}

TEST(CrossSection, FlowRateIsExactAndInvariantUnderMotion) {
  CellDisc disc = cross_section(ellipse(6, true));
  const CrossSection still(disc.points, disc.faces);
  const Eigen::AngleAxisd turn(1.1, Vec3(1.0, 2.0, -0.5).normalized());
  for (Vec3& p : disc.points) p = turn * p * 1e-3 + Vec3(5.0, -7.0, 2.0);
  const CrossSection moved(disc.points, disc.faces);
  const std::vector<double> u = still.steady();
  const std::vector<double> v = moved.steady();
  double flow = 0.0;
  for (std::size_t f = 0; f < u.size(); ++f) {
    EXPECT_NEAR(u[f], v[f], 1e-8);
    flow += u[f] * still.face_areas()[f];
  }
  EXPECT_NEAR(flow / still.area(), 1.0, 1e-14);
  EXPECT_NEAR((moved.normal() - turn * -Vec3::UnitZ()).norm(), 0.0, 1e-9);
  EXPECT_NEAR(moved.area() / still.area(), 1e-6, 1e-14);
  EXPECT_NEAR(moved.perimeter() / still.perimeter(), 1e-3, 1e-11);
}

TEST(CrossSection, AnOpeningOfOneFaceHasAProfile) {
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const CrossSection quad(points, {{{0, 1, 2, 3}, 0}});
  EXPECT_DOUBLE_EQ(quad.steady().front(), 1.0);
  const CrossSection triangle(points, {{{0, 1, 2, -1}, 0}});
  EXPECT_DOUBLE_EQ(triangle.steady().front(), 1.0);
}

TEST(CrossSection, RefusesWhatIsNoOpening) {
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}};
  test::expect_error(ExitCode::internal, {"rim"}, [&] { CrossSection(points, {}); });
  test::expect_error(ExitCode::internal, {"no area"}, [&] {
    CrossSection(points, {{{0, 1, 2, -1}, 0}, {{0, 2, 3, -1}, 0}});
  });
}

}  // namespace
}  // namespace hexwall
