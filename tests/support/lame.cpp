#include "support/lame.h"

#include <Eigen/Dense>

namespace hexwall::test {

LameCylinder::LameCylinder(double inner_radius, const std::vector<ElasticLayer>& layers,
                           double pressure) {
  for (const auto& [radius, young, poisson] : layers) {
    const double shear = young / (1 + poisson);
    layers_.push_back({radius, 0, 0, shear / (1 - 2 * poisson), shear});
  }
  // Unknowns a and b of each layer; radial stress = bulk a - shear b / r².
  const auto n = static_cast<Eigen::Index>(2 * layers.size());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(n);
  const auto add_stress = [&](Eigen::Index row, Eigen::Index layer, double r, double sign) {
    matrix(row, 2 * layer) += sign * layers_[layer].bulk;
    matrix(row, 2 * layer + 1) -= sign * layers_[layer].shear / (r * r);
  };
  add_stress(0, 0, inner_radius, 1);
  right(0) = -pressure;
  for (Eigen::Index k = 0; k + 1 < n / 2; ++k) {
    const double r = layers_[k].outer_radius;
    add_stress(2 * k + 1, k, r, 1);
    add_stress(2 * k + 1, k + 1, r, -1);
    matrix.row(2 * k + 2).segment(2 * k, 4) << r, 1 / r, -r, -1 / r;
  }
  add_stress(n - 1, n / 2 - 1, layers_.back().outer_radius, 1);
  const Eigen::VectorXd solution = matrix.fullPivLu().solve(right);
  for (std::size_t k = 0; k < layers_.size(); ++k) {
    layers_[k].a = solution(static_cast<Eigen::Index>(2 * k));
    layers_[k].b = solution(static_cast<Eigen::Index>(2 * k + 1));
  }
}

const LameCylinder::Constants& LameCylinder::at(double r) const {
  for (const Constants& layer : layers_)
    if (r < layer.outer_radius) return layer;
  return layers_.back();
}

double LameCylinder::radial_displacement(double r) const {
  return at(r).a * r + at(r).b / r;
}

double LameCylinder::radial_stress(double r) const {
  return at(r).bulk * at(r).a - at(r).shear * at(r).b / (r * r);
}

double LameCylinder::hoop_stress(double r) const {
  return at(r).bulk * at(r).a + at(r).shear * at(r).b / (r * r);
}

}  // namespace hexwall::test
