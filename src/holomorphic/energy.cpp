#include "holomorphic/energy.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <Eigen/Geometry>

namespace hexwall {
namespace {

// Their sums are taken over as many triangles of the input at a time.
constexpr Eigen::Index chunk = 4096;

// Gradients of n piecewise linear functions on one triangle, times sqrt(area / rho): 2 x n in a
// frame of the triangle, so that the column products integrate grad g_i . grad g_j / rho.
template <class Gradients>
void find_scaled_gradients(const AreaEnergyInput& input, int f, Gradients&& gradients) {
  const auto& [a, b, c] = input.surface.triangles[f];
  const Vec3 u = input.surface.points[b] - input.surface.points[a];
  const Vec3 v = input.surface.points[c] - input.surface.points[a];
  const double length = u.norm();
  const double along = u.dot(v) / length;
  const double height = u.cross(v).norm() / length;
  const double scale = std::sqrt(0.5 * length * height / input.rho[input.parent_face[f]]);
  for (Eigen::Index i = 0; i < input.g.cols(); ++i) {
    const double x = (input.g(b, i) - input.g(a, i)) / length;
    const double y = (input.g(c, i) - input.g(a, i) - along * x) / height;
    gradients(0, i) = scale * x;
    gradients(1, i) = scale * y;
  }
}

/// The triangles of the refined surface that count, ordered by the input triangles they lie in, and
/// those, numbered from 0.
struct Pieces {
  explicit Pieces(const AreaEnergyInput& input) {
    std::vector<int> first(input.parent_count + 1, 0);
    for (const int parent : input.parent_face) {
      if (parent >= 0) ++first[parent + 1];
    }
    std::vector<int> number(input.parent_count, -1);
    int count = 0;
    for (int parent = 0; parent < input.parent_count; ++parent) {
      if (first[parent + 1] > 0) number[parent] = count++;
    }
    std::partial_sum(first.begin(), first.end(), first.begin());
    faces.resize(first.back());
    parents.resize(first.back());
    areas = Eigen::VectorXd::Zero(count);
    for (int f = 0; f < static_cast<int>(input.parent_face.size()); ++f) {
      const int parent = input.parent_face[f];
      if (parent < 0) continue;
      const int place = first[parent]++;
      faces[place] = f;
      parents[place] = number[parent];
      areas[number[parent]] += 0.5 * doubled_area_vector(input.surface, f).norm();
    }
  }

  std::vector<int> faces, parents;
  Eigen::VectorXd areas;  // of the parents
};

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

// E = q^T A q - 2 b^T q + 1 in the monomials q = (lambda_i lambda_j)_{i <= j}.
class QuarticEnergy final : public AreaEnergy {
 public:
  explicit QuarticEnergy(const AreaEnergyInput& input) : n_(static_cast<int>(input.g.cols())) {
    const Pieces pieces(input);
    const int m = monomial_count(n_);
    quadratic_ = Eigen::MatrixXd::Zero(m, m);
    linear_ = Eigen::VectorXd::Zero(m);
    const double scale = 1.0 / pieces.areas.squaredNorm();
    Eigen::Matrix2Xd gradients(2, n_);
    std::size_t next = 0;
    for (Eigen::Index first = 0; first < pieces.areas.size(); first += chunk) {
      const Eigen::Index count = std::min(chunk, pieces.areas.size() - first);
      Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(m, count);
      for (; next < pieces.faces.size() && pieces.parents[next] < first + count; ++next) {
        find_scaled_gradients(input, pieces.faces[next], gradients);
        auto row = rows.col(pieces.parents[next] - first);
        for_monomials(n_, [&](int k, int i, int j) {
          row[k] += (i == j ? 1.0 : 2.0) * gradients.col(i).dot(gradients.col(j));
        });
      }
      quadratic_.selfadjointView<Eigen::Lower>().rankUpdate(rows, scale);
      linear_ += scale * (rows * pieces.areas.segment(first, count));
    }
    quadratic_ = Eigen::MatrixXd(quadratic_.selfadjointView<Eigen::Lower>());
  }

  int size() const override { return n_; }

  double value(const Eigen::VectorXd& lambda) const override {
    const Eigen::VectorXd q = monomials(lambda);
    return q.dot(quadratic_ * q - 2.0 * linear_) + 1.0;
  }

  Ray along(const Eigen::VectorXd& lambda) const override {
    const Eigen::VectorXd q = monomials(lambda);
    return {q.dot(quadratic_ * q), q.dot(linear_)};
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
};

}  // namespace

FacewiseEnergy::FacewiseEnergy(const AreaEnergyInput& input) {
  Pieces pieces(input);
  gradients_.resize(2 * static_cast<Eigen::Index>(pieces.faces.size()), input.g.cols());
  for (std::size_t i = 0; i < pieces.faces.size(); ++i) {
    find_scaled_gradients(input, pieces.faces[i],
                          gradients_.middleRows<2>(2 * static_cast<Eigen::Index>(i)));
  }
  parent_face_ = std::move(pieces.parents);
  areas_ = std::move(pieces.areas);
  scale_ = 1.0 / areas_.squaredNorm();
}

Eigen::VectorXd FacewiseEnergy::images(const Eigen::VectorXd& y) const {
  Eigen::VectorXd image = Eigen::VectorXd::Zero(areas_.size());
  for (std::size_t f = 0; f < parent_face_.size(); ++f) {
    image[parent_face_[f]] += y.segment<2>(2 * static_cast<Eigen::Index>(f)).squaredNorm();
  }
  return image;
}

double FacewiseEnergy::value(const Eigen::VectorXd& lambda) const {
  return scale_ * (images(gradients_ * lambda) - areas_).squaredNorm();
}

AreaEnergy::Ray FacewiseEnergy::along_gradients(const Eigen::VectorXd& y) const {
  const Eigen::VectorXd image = images(y);
  return {scale_ * image.squaredNorm(), scale_ * image.dot(areas_)};
}

AreaEnergy::Ray FacewiseEnergy::along(const Eigen::VectorXd& lambda) const {
  return along_gradients(gradients_ * lambda);
}

// E = sum r_T^2, r_T = |T|_lambda / rho - |T|; dr_T = 2 sum over T's pieces of G^T (G lambda).
void FacewiseEnergy::derivatives(const Eigen::VectorXd& lambda, Eigen::VectorXd& gradient,
                                 Eigen::MatrixXd& hessian) const {
  const Eigen::VectorXd y = gradients_ * lambda;
  const Eigen::VectorXd r = images(y) - areas_;
  Eigen::VectorXd weights(y.size());
  Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(size(), areas_.size());
  for (std::size_t f = 0; f < parent_face_.size(); ++f) {
    const auto row = 2 * static_cast<Eigen::Index>(f);
    weights.segment<2>(row).setConstant(r[parent_face_[f]]);
    slopes.col(parent_face_[f]) += gradients_.middleRows<2>(row).transpose() * y.segment<2>(row);
  }
  gradient = 4.0 * scale_ * (gradients_.transpose() * weights.cwiseProduct(y));
  hessian = Eigen::MatrixXd::Zero(size(), size());
  hessian.selfadjointView<Eigen::Lower>().rankUpdate(slopes, 8.0 * scale_);
  hessian.triangularView<Eigen::Lower>() +=
      4.0 * scale_ * gradients_.transpose() * (weights.asDiagonal() * gradients_);
  hessian = Eigen::MatrixXd(hessian.selfadjointView<Eigen::Lower>());
}

double AreaEnergy::Ray::best_scale() const {
  return a > 0.0 && b > 0.0 ? std::sqrt(b / a) : 1.0;
}

double AreaEnergy::Ray::least() const {
  return a > 0.0 && b > 0.0 ? 1.0 - b * b / a : 1.0;
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

std::unique_ptr<AreaEnergy> area_energy(const AreaEnergyInput& input) {
  if (input.g.cols() <= largest_quartic) return quartic_energy(input);
  return std::make_unique<FacewiseEnergy>(input);
}

}  // namespace hexwall
