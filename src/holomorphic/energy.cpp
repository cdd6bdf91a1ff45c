#include "holomorphic/energy.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>

namespace hexwall {
namespace {

// Up to here the n^4 coefficients cost less than the triangles they replace.
constexpr int largest_quartic = 30;

// Gradients of n piecewise linear functions on one triangle, times sqrt(area / rho): 2 x n in a
// frame of the triangle, so that the column products integrate grad g_i . grad g_j / rho.
Eigen::Matrix2Xd scaled_gradients(const AreaEnergyInput& input, int f) {
  const auto& [a, b, c] = input.surface.triangles[f];
  const Vec3 u = input.surface.points[b] - input.surface.points[a];
  const Vec3 v = input.surface.points[c] - input.surface.points[a];
  const double length = u.norm();
  const double along = u.dot(v) / length;
  const double height = u.cross(v).norm() / length;
  Eigen::Matrix2Xd gradients(2, input.g.cols());
  gradients.row(0) = (input.g.row(b) - input.g.row(a)) / length;
  gradients.row(1) = (input.g.row(c) - input.g.row(a) - along * gradients.row(0)) / height;
  return gradients * std::sqrt(0.5 * length * height / input.rho[input.parent_face[f]]);
}

Eigen::VectorXd parent_areas(const AreaEnergyInput& input) {
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(input.parent_count);
  for (std::size_t f = 0; f < input.parent_face.size(); ++f) {
    if (input.parent_face[f] < 0) continue;
    areas[input.parent_face[f]] +=
        0.5 * doubled_area_vector(input.surface, static_cast<int>(f)).norm();
  }
  return areas;
}

int monomial_count(int n) {
  return n * (n + 1) / 2;
}

// Calls visit(k, i, j) for the k-th monomial lambda_i lambda_j, i <= j.
template <class Visit>
void for_monomials(int n, Visit visit) {
  for (int i = 0, k = 0; i < n; ++i) {
    for (int j = i; j < n; ++j) visit(k++, i, j);
  }
}

// E = q^T A q - 2 b^T q + s in the monomials q = (lambda_i lambda_j)_{i <= j}.
class QuarticEnergy final : public AreaEnergy {
 public:
  explicit QuarticEnergy(const AreaEnergyInput& input) : n_(static_cast<int>(input.g.cols())) {
    const Eigen::VectorXd areas = parent_areas(input);
    const int m = monomial_count(n_);
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(m, input.parent_count);
    for (std::size_t f = 0; f < input.parent_face.size(); ++f) {
      if (input.parent_face[f] < 0) continue;
      const Eigen::Matrix2Xd gradients = scaled_gradients(input, static_cast<int>(f));
      auto row = rows.col(input.parent_face[f]);
      for_monomials(n_, [&](int k, int i, int j) {
        row[k] += (i == j ? 1.0 : 2.0) * gradients.col(i).dot(gradients.col(j));
      });
    }
    const double scale = 1.0 / areas.squaredNorm();
    quadratic_ = Eigen::MatrixXd::Zero(m, m);
    quadratic_.selfadjointView<Eigen::Lower>().rankUpdate(rows, scale);
    quadratic_ = Eigen::MatrixXd(quadratic_.selfadjointView<Eigen::Lower>());
    linear_ = scale * (rows * areas);
    constant_ = 1.0;
  }

  int size() const override { return n_; }

  double value(const Eigen::VectorXd& lambda) const override {
    const Eigen::VectorXd q = monomials(lambda);
    return q.dot(quadratic_ * q - 2.0 * linear_) + constant_;
  }

  void derivatives(const Eigen::VectorXd& lambda, Eigen::VectorXd& gradient,
                   Eigen::MatrixXd& hessian) const override {
    const Eigen::VectorXd slope = 2.0 * (quadratic_ * monomials(lambda) - linear_);
    // The derivative of a monomial has two entries: A times all of them costs n^3 only.
    Eigen::MatrixXd product = Eigen::MatrixXd::Zero(slope.size(), n_);
    gradient = Eigen::VectorXd::Zero(n_);
    hessian = Eigen::MatrixXd::Zero(n_, n_);
    for_monomials(n_, [&](int k, int i, int j) {
      product.col(i) += lambda[j] * quadratic_.col(k);
      product.col(j) += lambda[i] * quadratic_.col(k);
      gradient[i] += lambda[j] * slope[k];
      gradient[j] += lambda[i] * slope[k];
      hessian(i, j) += slope[k];
      hessian(j, i) += slope[k];
    });
    for_monomials(n_, [&](int k, int i, int j) {
      hessian.row(i) += 2.0 * lambda[j] * product.row(k);
      hessian.row(j) += 2.0 * lambda[i] * product.row(k);
    });
  }

 private:
  Eigen::VectorXd monomials(const Eigen::VectorXd& lambda) const {
    Eigen::VectorXd q(monomial_count(n_));
    for_monomials(n_, [&](int k, int i, int j) { q[k] = lambda[i] * lambda[j]; });
    return q;
  }

  int n_;
  Eigen::MatrixXd quadratic_;
  Eigen::VectorXd linear_;
  double constant_ = 0.0;
};

// Keeps the scaled gradients of all triangles, grouped by parent.
class FacewiseEnergy final : public AreaEnergy {
 public:
  explicit FacewiseEnergy(const AreaEnergyInput& input) {
    std::vector<int> faces;
    for (std::size_t f = 0; f < input.parent_face.size(); ++f) {
      if (input.parent_face[f] < 0) continue;
      faces.push_back(static_cast<int>(f));
      parent_face_.push_back(input.parent_face[f]);
    }
    gradients_.resize(2 * static_cast<Eigen::Index>(faces.size()), input.g.cols());
    for (std::size_t i = 0; i < faces.size(); ++i) {
      gradients_.middleRows<2>(2 * static_cast<Eigen::Index>(i)) =
          scaled_gradients(input, faces[i]);
    }
    areas_ = parent_areas(input);
    scale_ = 1.0 / areas_.squaredNorm();
  }

  int size() const override { return static_cast<int>(gradients_.cols()); }

  double value(const Eigen::VectorXd& lambda) const override {
    return scale_ * residuals(gradients_ * lambda).squaredNorm();
  }

  // E = sum r_T^2, r_T = |T|_lambda / rho - |T|; dr_T = 2 sum over T's pieces of G^T (G lambda).
  void derivatives(const Eigen::VectorXd& lambda, Eigen::VectorXd& gradient,
                   Eigen::MatrixXd& hessian) const override {
    const Eigen::VectorXd y = gradients_ * lambda;
    const Eigen::VectorXd r = residuals(y);
    Eigen::VectorXd weights(y.size());
    for (std::size_t f = 0; f < parent_face_.size(); ++f) {
      weights.segment<2>(2 * static_cast<Eigen::Index>(f)).setConstant(r[parent_face_[f]]);
    }
    gradient = 4.0 * scale_ * (gradients_.transpose() * weights.cwiseProduct(y));
    Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(areas_.size(), size());
    for (std::size_t f = 0; f < parent_face_.size(); ++f) {
      const auto row = 2 * static_cast<Eigen::Index>(f);
      slopes.row(parent_face_[f]) +=
          2.0 * y.segment<2>(row).transpose() * gradients_.middleRows<2>(row);
    }
    hessian = 2.0 * scale_ * (slopes.transpose() * slopes) +
              4.0 * scale_ * (gradients_.transpose() * weights.asDiagonal() * gradients_);
  }

 private:
  Eigen::VectorXd residuals(const Eigen::VectorXd& y) const {
    Eigen::VectorXd r = -areas_;
    for (std::size_t f = 0; f < parent_face_.size(); ++f) {
      r[parent_face_[f]] += y.segment<2>(2 * static_cast<Eigen::Index>(f)).squaredNorm();
    }
    return r;
  }

  std::vector<int> parent_face_;
  Eigen::MatrixXd gradients_;
  Eigen::VectorXd areas_;
  double scale_ = 1.0;
};

}  // namespace

double AreaEnergy::best_scale(const Eigen::VectorXd& lambda) const {
  // E(t lambda) = a t^4 - 2 b t^2 + s: fitted through t = 0, 1 and sqrt(2), where it is exact.
  const double s = value(Eigen::VectorXd::Zero(lambda.size()));
  const double one = value(lambda) - s;
  const double two = value(std::sqrt(2.0) * lambda) - s;
  const double a = 0.5 * (two - 2.0 * one);
  const double b = 0.5 * (a - one);
  return a > 0.0 && b > 0.0 ? std::sqrt(b / a) : 1.0;
}

std::vector<int> sampled_parents(const AreaEnergyInput& input, int count) {
  const int every = std::max(1, input.parent_count / std::max(1, count));
  std::vector<int> parents = input.parent_face;
  for (int& parent : parents) {
    if (parent % every != 0) parent = -1;
  }
  return parents;
}

std::unique_ptr<AreaEnergy> quartic_energy(const AreaEnergyInput& input) {
  return std::make_unique<QuarticEnergy>(input);
}

std::unique_ptr<AreaEnergy> facewise_energy(const AreaEnergyInput& input) {
  return std::make_unique<FacewiseEnergy>(input);
}

std::unique_ptr<AreaEnergy> area_energy(const AreaEnergyInput& input) {
  return input.g.cols() <= largest_quartic ? quartic_energy(input) : facewise_energy(input);
}

}  // namespace hexwall
