#include "holomorphic/optimum.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include <Eigen/Eigenvalues>

#include "core/cancel.h"
#include "core/tolerances.h"

namespace hexwall {
namespace {

// The minimiser of g.s + s.H s / 2 within |s| <= radius, in the eigenbasis of H: s = -g / (e + mu)
// with the least mu >= 0 that keeps H + mu positive and s inside.
Eigen::VectorXd trust_region_step(const Eigen::VectorXd& gradient, const Eigen::MatrixXd& hessian,
                                  double radius) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(hessian);
  const Eigen::VectorXd& e = eigen.eigenvalues();
  const Eigen::VectorXd g = eigen.eigenvectors().transpose() * gradient;
  const auto step = [&](double mu) -> Eigen::VectorXd {
    return -(g.array() / (e.array() + mu)).matrix();
  };
  const double scale = e.cwiseAbs().maxCoeff();
  double low = std::max(0.0, -e[0]) + 1e-14 * scale;
  if (step(low).norm() > radius) {
    double high = low + g.norm() / radius;
    for (int i = 0; i < 60 && high - low > 1e-12 * high; ++i) {
      const double mu = 0.5 * (low + high);
      (step(mu).norm() > radius ? low : high) = mu;
    }
    low = high;
  }
  return eigen.eigenvectors() * step(low);
}

double exterior_period(const Eigen::VectorXd& lambda) {
  return -lambda.sum();
}

bool has_both_signs(const std::vector<int>& signs) {
  return std::any_of(signs.begin(), signs.end(), [&](int s) { return s != signs.front(); });
}

class Search {
 public:
  Search(const AreaEnergy& energy, const std::vector<double>& lengths, int exterior,
         const OptimumOptions& options)
      : energy_(energy), lengths_(lengths), exterior_(exterior), options_(options) {}

  OptimumResult run() {
    if (energy_.size() <= options_.exhaustive_limit) {
      try_every_pattern();
    } else {
      search_sign_flips();
    }
    const auto less = [](const Descent& a, const Descent& b) { return a.energy < b.energy; };
    const auto best = std::min_element(result_.descents.begin(), result_.descents.end(), less);
    result_.best = static_cast<int>(best - result_.descents.begin());
    result_.lambda = oriented(best->lambda);
    result_.energy = best->energy;
    return std::move(result_);
  }

 private:
  const Descent& descend_from(const std::vector<int>& signs) {
    Eigen::VectorXd start = balanced_start(signs, lengths_, exterior_);
    start *= energy_.best_scale(start);
    result_.descents.push_back(descend(energy_, start, options_.max_iterations));
    result_.descents.back().signs = signs;
    return result_.descents.back();
  }

  void try_every_pattern() {
    for_sign_patterns(energy_.size() + 1,
                      [&](const std::vector<int>& signs) { descend_from(signs); });
  }

  // First by the energies of the starts alone, which are cheap; a descent from each pattern found,
  // and from the random ones, for variety; then by descents, from the best of these.
  void search_sign_flips() {
    std::mt19937_64 random(options_.seed);
    std::set<std::vector<int>> patterns;
    for (int restart = 0; restart < options_.search_restarts; ++restart) {
      std::vector<int> signs(lengths_.size());
      do {
        for (int& s : signs) s = (random() >> 32 & 1U) != 0 ? -1 : 1;
      } while (!has_both_signs(signs));
      patterns.insert(signs);
      improve_by_flips(signs, [&] { return start_energy(signs); });
      patterns.insert(signs);
    }
    for (const std::vector<int>& signs : patterns) descend_from(signs);
    auto sorted = result_.descents;
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const Descent& a, const Descent& b) { return a.energy < b.energy; });
    const int count = std::min(options_.search_finalists, static_cast<int>(sorted.size()));
    for (int i = 0; i < count; ++i) {
      std::vector<int> signs = sorted[i].signs;
      improve_by_flips(signs, [&] { return descend_from(signs).energy; });
    }
  }

  double start_energy(const std::vector<int>& signs) const {
    const Eigen::VectorXd start = balanced_start(signs, lengths_, exterior_);
    return energy_.value(energy_.best_scale(start) * start);
  }

  // Flips one sign at a time as long as `energy`, of the signs as they are, falls.
  template <typename Energy>
  static void improve_by_flips(std::vector<int>& signs, Energy energy) {
    double best = energy();
    int untried = static_cast<int>(signs.size());
    for (std::size_t i = 0; untried > 0; i = (i + 1) % signs.size(), --untried) {
      signs[i] = -signs[i];
      const double flipped = has_both_signs(signs) ? energy() : best;
      if (flipped < best - tolerance::energy_decrease) {
        best = flipped;
        untried = static_cast<int>(signs.size());
      } else {
        signs[i] = -signs[i];
      }
    }
  }

  Eigen::VectorXd oriented(const Eigen::VectorXd& lambda) const {
    Eigen::Index largest = 0;
    const double inner = lambda.cwiseAbs().maxCoeff(&largest);
    const double outer = exterior_period(lambda);
    const double decisive = std::abs(outer) > inner * (1.0 + 1e-9) ? outer : lambda[largest];
    return decisive < 0.0 ? -lambda : lambda;
  }

  const AreaEnergy& energy_;
  const std::vector<double>& lengths_;
  int exterior_;
  const OptimumOptions& options_;
  OptimumResult result_;
};

}  // namespace

Eigen::VectorXd balanced_start(const std::vector<int>& signs, const std::vector<double>& lengths,
                               int exterior) {
  double positive = 0.0;
  double negative = 0.0;
  for (std::size_t i = 0; i < signs.size(); ++i) {
    (signs[i] > 0 ? positive : negative) += lengths[i];
  }
  const double ratio = std::sqrt(negative / positive);
  Eigen::VectorXd lambda(static_cast<Eigen::Index>(signs.size()) - 1);
  for (int i = 0, k = 0; i < static_cast<int>(signs.size()); ++i) {
    if (i == exterior) continue;
    lambda[k++] = signs[i] > 0 ? ratio * lengths[i] : -lengths[i] / ratio;
  }
  return lambda;
}

Descent descend(const AreaEnergy& energy, const Eigen::VectorXd& start, int max_iterations) {
  Descent descent;
  descent.lambda = start;
  descent.energy = energy.value(start);
  descent.iterations.push_back(descent.energy);
  double radius = 0.5 * start.norm();
  Eigen::VectorXd gradient;
  Eigen::MatrixXd hessian;
  energy.derivatives(descent.lambda, gradient, hessian);
  for (int i = 0; i < max_iterations; ++i) {
    throw_if_cancelled();
    const Eigen::VectorXd step = trust_region_step(gradient, hessian, radius);
    const double predicted = -gradient.dot(step) - 0.5 * step.dot(hessian * step);
    if (!(predicted > tolerance::energy_decrease)) break;
    const double next = energy.value(descent.lambda + step);
    const double ratio = (descent.energy - next) / predicted;
    if (ratio < 0.25) radius *= 0.25;
    if (ratio > 0.75) radius = std::max(radius, 2.0 * step.norm());
    if (!(next < descent.energy)) continue;
    descent.lambda += step;
    descent.energy = next;
    descent.iterations.push_back(next);
    energy.derivatives(descent.lambda, gradient, hessian);
  }
  return descent;
}

OptimumResult optimal_form(const AreaEnergy& energy, const std::vector<double>& loop_lengths,
                           int exterior, const OptimumOptions& options) {
  return Search(energy, loop_lengths, exterior, options).run();
}

}  // namespace hexwall
