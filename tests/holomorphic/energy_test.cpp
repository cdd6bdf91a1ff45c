#include "holomorphic/energy.h"

#include <cmath>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "support/harmonic_forms.h"

namespace hexwall {
namespace {

using test::Harmonic;
using test::harmonic;

// Energies of a surface with a weight that differs from triangle to triangle.
class Energy : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    const TriangleSurface* surface = test::vessel_surface(GetParam());
    if (surface == nullptr) GTEST_SKIP() << "no shared data: " << GetParam();
    h_ = harmonic(*surface);
    rho_.resize(h_.input_faces);
    for (int f = 0; f < h_.input_faces; ++f) rho_[f] = 1.0 + 0.5 * std::sin(f);
    const AreaEnergyInput input{h_.surface(), h_.refined.parent_face, h_.input_faces, h_.g, rho_};
    quartic_ = quartic_energy(input);
    facewise_ = std::make_unique<FacewiseEnergy>(input);
    // About the scale of the optimum, where the energy is of order one.
    scale_ = std::sqrt(total_area(h_.surface()));
  }

  Eigen::VectorXd random_lambda() {
    Eigen::VectorXd lambda(h_.n());
    for (double& value : lambda) {
      value = scale_ * (static_cast<double>(random_() >> 11) * 0x1.0p-53 - 0.5);
    }
    return lambda;
  }

  Harmonic h_;
  Eigen::VectorXd rho_;
  std::unique_ptr<AreaEnergy> quartic_, facewise_;
  double scale_ = 1.0;
  std::mt19937_64 random_{17};
};

INSTANTIATE_TEST_SUITE_P(Some, Energy,
                         testing::Values("eccentric_annulus", "bifurcation", "tree",
                                         "vampy_ica_artery_C0015.vtp"),
                         [](const auto& param) { return test::alphanumeric(param.param); });

TEST_P(Energy, IsTheDistortionOfTheAreas) {
  const Eigen::VectorXd lambda = random_lambda();
  const HolomorphicForm form = h_.form(lambda);
  Eigen::VectorXd area = Eigen::VectorXd::Zero(h_.input_faces);
  Eigen::VectorXd image = area;
  for (int f = 0; f < h_.mesh.face_count(); ++f) {
    const double piece = 0.5 * doubled_area_vector(h_.surface(), f).norm();
    area[h_.refined.parent_face[f]] += piece;
    image[h_.refined.parent_face[f]] +=
        piece * test::gradient(h_.surface(), form.y, f).squaredNorm();
  }
  const double expected = (image.cwiseQuotient(rho_) - area).squaredNorm() / area.squaredNorm();
  EXPECT_NEAR(quartic_->value(lambda), expected, 1e-9 * expected);
  EXPECT_NEAR(facewise_->value(lambda), expected, 1e-9 * expected);
}

TEST_P(Energy, BothEvaluationsAgree) {
  ASSERT_EQ(quartic_->size(), h_.n());
  ASSERT_EQ(facewise_->size(), h_.n());
  for (int i = 0; i < 10; ++i) {
    const Eigen::VectorXd lambda = random_lambda();
    const double value = facewise_->value(lambda);
    EXPECT_NEAR(quartic_->value(lambda), value, 1e-10 * value);
    Eigen::VectorXd g1;
    Eigen::VectorXd g2;
    Eigen::MatrixXd h1;
    Eigen::MatrixXd h2;
    quartic_->derivatives(lambda, g1, h1);
    facewise_->derivatives(lambda, g2, h2);
    EXPECT_LT((g1 - g2).norm(), 1e-9 * g2.norm());
    EXPECT_LT((h1 - h2).norm(), 1e-9 * h2.norm());
    EXPECT_LT((h2 - h2.transpose()).norm(), 1e-12 * h2.norm());
  }
}

TEST_P(Energy, DerivativesAreThoseOfTheValue) {
  for (const AreaEnergy* energy : {quartic_.get(), facewise_.get()}) {
    const Eigen::VectorXd lambda = random_lambda();
    Eigen::VectorXd gradient;
    Eigen::MatrixXd hessian;
    energy->derivatives(lambda, gradient, hessian);
    const double step = 1e-4 * scale_;
    Eigen::VectorXd up;
    Eigen::VectorXd down;
    Eigen::MatrixXd unused;
    for (int i = 0; i < h_.n(); ++i) {
      const Eigen::VectorXd shift = step * Eigen::VectorXd::Unit(h_.n(), i);
      const double slope =
          (energy->value(lambda + shift) - energy->value(lambda - shift)) / (2.0 * step);
      EXPECT_NEAR(slope, gradient[i], 1e-6 * gradient.norm());
      energy->derivatives(lambda + shift, up, unused);
      energy->derivatives(lambda - shift, down, unused);
      EXPECT_LT(((up - down) / (2.0 * step) - hessian.col(i)).norm(), 1e-6 * hessian.norm());
    }
  }
}

TEST_P(Energy, IsEvenAndEndsAtTheWeight) {
  const Eigen::VectorXd lambda = random_lambda();
  EXPECT_EQ(quartic_->value(lambda), quartic_->value(-lambda));
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(h_.n());
  EXPECT_NEAR(quartic_->value(zero), facewise_->value(zero), 1e-12);
}

TEST_P(Energy, BestScaleIsTheMinimiserAlongTheRay) {
  for (int i = 0; i < 10; ++i) {
    const Eigen::VectorXd lambda = random_lambda();
    const double t = quartic_->along(lambda).best_scale();
    ASSERT_GT(t, 0.0);
    Eigen::VectorXd gradient;
    Eigen::MatrixXd hessian;
    quartic_->derivatives(t * lambda, gradient, hessian);
    EXPECT_NEAR(gradient.dot(lambda), 0.0, 1e-7 * hessian.norm() * lambda.squaredNorm());
    const double least = quartic_->value(t * lambda);
    for (const double factor : {0.0, 0.5, 0.9, 0.99, 1.01, 1.1, 2.0}) {
      EXPECT_GT(quartic_->value(factor * t * lambda), least);
    }
    EXPECT_NEAR(quartic_->along(3.0 * lambda).best_scale(), t / 3.0, 1e-8 * t);
    EXPECT_NEAR(quartic_->along(lambda).least(), least, 1e-12);
    EXPECT_NEAR(facewise_->along(lambda).best_scale(), t, 1e-8 * t);
    EXPECT_NEAR(facewise_->along(lambda).least(), least, 1e-10);
  }
}

// On a straight tube every triangle keeps its area if the circumference is the tube's.
TEST(EnergyOfCylinder, VanishesAtTheDevelopment) {
  const Harmonic h = harmonic(cylinder(1.0, 6.0, 24, 25));
  const auto energy = test::energy_of(h);
  const double perimeter = 48.0 * std::sin(std::acos(-1.0) / 24.0);
  const Eigen::VectorXd lambda = Eigen::VectorXd::Constant(1, perimeter);
  EXPECT_NEAR(energy->value(lambda), 0.0, 1e-12);
  EXPECT_NEAR(energy->along(0.3 * lambda).best_scale(), 1.0 / 0.3, 1e-8);
}

TEST(EnergyOfManyLoops, IsTheCheaperOfTheTwo) {
  const Harmonic h = harmonic(*test::vessel_surface("bifurcation"));
  const auto chosen = test::energy_of(h);
  Eigen::VectorXd lambda(2);
  lambda << 4.0, -3.0;
  const Eigen::VectorXd rho = Eigen::VectorXd::Ones(h.input_faces);
  const auto quartic =
      quartic_energy({h.surface(), h.refined.parent_face, h.input_faces, h.g, rho});
  EXPECT_EQ(chosen->value(lambda), quartic->value(lambda));
}

}  // namespace
}  // namespace hexwall
