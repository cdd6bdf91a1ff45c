#include "holomorphic/basis.h"

#include <cmath>
#include <functional>
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

// Orders of convergence between successive values of an error that is measured on meshes each twice
// as fine as the one before.
std::vector<double> orders(const std::vector<double>& errors) {
  std::vector<double> result;
  for (std::size_t i = 1; i < errors.size(); ++i) {
    result.push_back(std::log2(errors[i - 1] / errors[i]));
  }
  return result;
}

void expect_second_order(const std::vector<double>& errors) {
  for (const double order : orders(errors)) {
    EXPECT_GT(order, 1.8);
    EXPECT_LT(order, 2.3);
  }
}

// Errors of one number of the basis on five meshes.
std::vector<double> errors_of(const std::function<TriangleSurface(int)>& surface,
                              const std::function<double(const Harmonic&)>& error) {
  std::vector<double> errors;
  for (int k = 1; k <= 16; k *= 2) errors.push_back(error(harmonic(surface(k))));
  return errors;
}

TriangleSurface concentric(int k) {
  return annulus(1.0, 2.0, 24 * k, 3 * k);
}
TriangleSurface eccentric(int k) {
  return eccentric_annulus(1.0, 0.3, 0.4, 24 * k, 5 * k);
}
const double concentric_capacity = 2.0 * pi / std::log(2.0);
// A Möbius map takes the two circles to concentric ones.
const double eccentric_capacity = 2.0 * pi / std::acosh((1.0 + 0.09 - 0.16) / (2.0 * 0.3));

TEST(ConcentricAnnulus, CapacityConvergesWithSecondOrder) {
  const auto errors = errors_of(concentric, [](const Harmonic& h) {
    return std::abs(h.basis.capacity(0, 0) - concentric_capacity);
  });
  expect_second_order(errors);
  EXPECT_LT(errors.back(), 1e-3);
}

TEST(ConcentricAnnulus, GramConvergesWithSecondOrder) {
  const auto errors = errors_of(concentric, [](const Harmonic& h) {
    return std::abs(h.periodic.gram(0, 0) - 1.0 / concentric_capacity);
  });
  expect_second_order(errors);
  EXPECT_LT(errors.back(), 1e-5);
}

TEST(ConcentricAnnulus, TheErrorIsAnEnclosureThatShrinksWithSecondOrder) {
  expect_second_order(errors_of(concentric, [](const Harmonic& h) {
    EXPECT_GT(h.periodic.gram(0, 0) * h.basis.capacity(0, 0), 1.0);
    return h.periodic.error;
  }));
}

TEST(EccentricAnnulus, CapacityConvergesWithSecondOrder) {
  const auto errors = errors_of(eccentric, [](const Harmonic& h) {
    return std::abs(h.basis.capacity(0, 0) - eccentric_capacity);
  });
  expect_second_order(errors);
  EXPECT_LT(errors.back(), 1e-3);
}

// Here triangles at the inner circle have obtuse angles opposite to the loop.
TEST(EccentricAnnulus, GramConvergesWithSecondOrder) {
  const auto errors = errors_of(eccentric, [](const Harmonic& h) {
    return std::abs(h.periodic.gram(0, 0) - 1.0 / eccentric_capacity);
  });
  expect_second_order(errors);
  EXPECT_LT(errors.back(), 1e-4);
}

TEST(EccentricAnnulus, TheErrorIsAnEnclosureThatShrinksWithSecondOrder) {
  expect_second_order(errors_of(eccentric, [](const Harmonic& h) {
    EXPECT_GT(h.periodic.gram(0, 0) * h.basis.capacity(0, 0), 1.0);
    return h.periodic.error;
  }));
}

TEST(Bifurcation, TheErrorFallsUnderRefinement) {
  std::vector<double> errors;
  for (const double edge : {0.4, 0.2, 0.1}) {
    errors.push_back(harmonic(generate_shape(Shape::bifurcation, edge)).periodic.error);
  }
  // Irregular meshes: the order is two on the average.
  EXPECT_LT(errors[2], errors[1]);
  EXPECT_GT(std::log2(errors[0] / errors[2]) / 2.0, 1.6);
}

// All triangles of the tube are alike, and the forms are constant on each of them.
TEST(Cylinder, FormsAreLinear) {
  const int n_around = 24;
  const int n_along = 25;
  const double length = 6.0;
  const TriangleSurface tube = cylinder(1.0, length, n_around, n_along);
  const Harmonic h = harmonic(tube);
  ASSERT_EQ(h.refined.splits, 0);
  const int loop = h.basis.loop(0);
  const double z_of_loop = tube.points[h.mesh.loops()[loop].front()].z();
  for (int v = 0; v < h.mesh.vertex_count(); ++v) {
    const double expected = 1.0 - std::abs(tube.points[v].z() - z_of_loop) / length;
    ASSERT_NEAR(h.basis.f(v, 0), expected, 1e-12);
  }
  // Perimeter of the polygon over the length along the faceted wall.
  const double perimeter = 2.0 * n_around * std::sin(pi / n_around);
  const double slant = std::hypot(length / n_along, 1.0 - std::cos(pi / n_around));
  EXPECT_NEAR(h.basis.capacity(0, 0), perimeter / (slant * n_along), 1e-12);
  EXPECT_NEAR(h.periodic.gram(0, 0), slant * n_along / perimeter, 1e-12);
}

class Basis : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    const TriangleSurface* surface = test::vessel_surface(GetParam());
    if (surface == nullptr) GTEST_SKIP() << "no shared data: " << GetParam();
    h_ = harmonic(*surface, exterior());
  }
  // Not always the first loop.
  int exterior() const { return GetParam().size() % 2 == 0 ? 1 : 0; }

  Harmonic h_;
};

INSTANTIATE_TEST_SUITE_P(Some, Basis,
                         testing::Values("annulus", "eccentric_annulus", "cylinder", "bifurcation",
                                         "tree", "palabos_aneurysm_open.stl",
                                         "vampy_artery_test_small.stl", "vampy_vein_test_small.stl",
                                         "vampy_ica_artery_C0015.vtp", "vascularmd_ideal_quads.vtk",
                                         "openlb_bifurcation3d.vtp"),
                         [](const auto& param) { return test::alphanumeric(param.param); });

TEST_P(Basis, ExactFormsAreHarmonicAndConstantOnLoops) {
  const Eigen::SparseMatrix<double> derivative = d0(h_.mesh);
  const Eigen::MatrixXd divergence =
      derivative.transpose() * (h_.star.asDiagonal() * (derivative * h_.basis.f));
  for (int v = 0; v < h_.mesh.vertex_count(); ++v) {
    for (int i = 0; i < h_.n(); ++i) {
      if (h_.mesh.is_boundary_vertex(v)) {
        const bool own = h_.mesh.loop_of_vertex(v) == h_.basis.loop(i);
        ASSERT_EQ(h_.basis.f(v, i), own ? 1.0 : 0.0);
      } else {
        ASSERT_NEAR(divergence(v, i), 0.0, 1e-10);
        ASSERT_GE(h_.basis.f(v, i), -1e-14);  // the maximum principle
        ASSERT_LE(h_.basis.f(v, i), 1.0 + 1e-14);
      }
    }
  }
}

TEST_P(Basis, PeriodicFormsAreClosedAndCoclosed) {
  const double largest = h_.periodic.omega.cwiseAbs().maxCoeff();
  const Eigen::MatrixXd curl = d1(h_.mesh) * h_.periodic.omega;
  EXPECT_LT(curl.cwiseAbs().maxCoeff(), 1e-12 * std::max(1.0, largest));
  const Eigen::MatrixXd divergence =
      d0(h_.mesh).transpose() * (h_.star.asDiagonal() * h_.periodic.omega);
  EXPECT_LT(divergence.cwiseAbs().maxCoeff(), 1e-10 * std::max(1.0, largest));
}

TEST_P(Basis, PeriodMatrixIsTheIdentity) {
  for (int i = 0; i < h_.n(); ++i) {
    for (int loop = 0; loop <= h_.n(); ++loop) {
      double expected = loop == h_.basis.loop(i) ? 1.0 : 0.0;
      if (loop == h_.basis.exterior) expected = -1.0;
      EXPECT_NEAR(period(h_.mesh, h_.periodic.form(i), loop), expected, 1e-10);
    }
  }
}

TEST_P(Basis, UnitFlowsAreExactlyClosedWithUnitPeriods) {
  const Eigen::MatrixXd eta =
      closed_forms(h_.mesh, h_.basis.exterior, Eigen::MatrixXd::Identity(h_.n(), h_.n()));
  ASSERT_EQ(eta.cols(), h_.n());
  EXPECT_EQ((d1(h_.mesh) * eta).cwiseAbs().maxCoeff(), 0.0);
  for (int i = 0; i < h_.n(); ++i) {
    for (int loop = 0; loop <= h_.n(); ++loop) {
      double expected = loop == h_.basis.loop(i) ? 1.0 : 0.0;
      if (loop == h_.basis.exterior) expected = -1.0;
      EXPECT_EQ(period(h_.mesh, {eta.col(i)}, loop), expected);
    }
  }
}

// Integral of a ^ b over the surface, for closed forms: they are constant on each triangle.
double wedge(const Connectivity& mesh, const OneForm& a, const OneForm& b) {
  double sum = 0.0;
  for (int f = 0; f < mesh.face_count(); ++f) {
    sum += 0.5 * (a.along(mesh, 3 * f) * b.along(mesh, 3 * f + 1) -
                  a.along(mesh, 3 * f + 1) * b.along(mesh, 3 * f));
  }
  return sum;
}

// The star on span(omega_i, df_i), projected in L2: <b_k, star b_j> = -integral of b_k ^ b_j.
TEST_P(Basis, StarSquaredIsMinusOne) {
  const int n = h_.n();
  std::vector<OneForm> forms;
  for (int i = 0; i < n; ++i) forms.push_back(h_.periodic.form(i));
  const Eigen::SparseMatrix<double> derivative = d0(h_.mesh);
  for (int i = 0; i < n; ++i) forms.push_back({derivative * h_.basis.f.col(i)});
  Eigen::MatrixXd inner(2 * n, 2 * n);
  Eigen::MatrixXd with_star(2 * n, 2 * n);
  for (int k = 0; k < 2 * n; ++k) {
    for (int j = 0; j < 2 * n; ++j) {
      inner(k, j) = forms[k].values.dot(h_.star.cwiseProduct(forms[j].values));
      with_star(k, j) = -wedge(h_.mesh, forms[k], forms[j]);
    }
  }
  // By Stokes the integral of df_j ^ omega_i is a period: 0 or 1, exactly.
  const Eigen::MatrixXd unit = Eigen::MatrixXd::Identity(n, n);
  EXPECT_LT((with_star.bottomLeftCorner(n, n) + unit).cwiseAbs().maxCoeff(), 1e-10);
  EXPECT_LT(with_star.topLeftCorner(n, n).cwiseAbs().maxCoeff(),
            h_.periodic.error * h_.periodic.gram.cwiseAbs().maxCoeff() + 1e-9);
  EXPECT_LT(with_star.bottomRightCorner(n, n).cwiseAbs().maxCoeff(), 1e-10);
  // Harmonic fields with zero periods are orthogonal to exact ones.
  EXPECT_LT(inner.topRightCorner(n, n).cwiseAbs().maxCoeff(), 1e-9);
  const Eigen::MatrixXd star = inner.llt().solve(with_star);
  const double defect =
      (star * star + Eigen::MatrixXd::Identity(star.rows(), star.cols())).cwiseAbs().maxCoeff();
  EXPECT_LT(defect, 3.0 * h_.periodic.error + 1e-9);
  EXPECT_LT(h_.periodic.error, 0.1);
  // star omega_i = -sum_j lambda_ij df_j
  const Eigen::MatrixXd expected = -h_.periodic.gram;
  EXPECT_LT((star.bottomLeftCorner(n, n) - expected).norm(),
            3.0 * n * h_.periodic.error * expected.norm() + 1e-9);
}

TEST_P(Basis, GramAndCapacityAreInverse) {
  const Eigen::MatrixXd product = h_.periodic.gram * h_.basis.capacity;
  const Eigen::MatrixXd unit = Eigen::MatrixXd::Identity(h_.n(), h_.n());
  EXPECT_NEAR((product - unit).cwiseAbs().maxCoeff(), h_.periodic.error, 1e-14);
  EXPECT_LT(h_.periodic.error, 0.05);
}

TEST(BasisOfAnyExterior, SpansTheSameForms) {
  const TriangleSurface& surface = *test::vessel_surface("bifurcation");
  const Harmonic first = harmonic(surface, 0);
  for (const int exterior : {1, 2}) {
    const Harmonic other = harmonic(surface, exterior);
    EXPECT_NEAR(other.periodic.error, first.periodic.error, 3.0 * first.periodic.error);
    // The form of the same periods is the same form.
    Eigen::VectorXd lambda(2);
    Eigen::VectorXd periods(3);
    periods << 3.0, -1.0, -2.0;
    for (int i = 0; i < 2; ++i) lambda[i] = periods[first.basis.loop(i)];
    const HolomorphicForm a = first.form(lambda);
    for (int i = 0; i < 2; ++i) lambda[i] = periods[other.basis.loop(i)];
    const HolomorphicForm b = other.form(lambda);
    EXPECT_LT((a.dx.values - b.dx.values).cwiseAbs().maxCoeff(), 1e-10);
    const Eigen::VectorXd difference = a.y - b.y;
    EXPECT_LT(difference.maxCoeff() - difference.minCoeff(), 1e-10);
    EXPECT_LT((a.periods - b.periods).cwiseAbs().maxCoeff(), 1e-12);
  }
}

}  // namespace
}  // namespace hexwall
