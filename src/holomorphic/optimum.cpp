#include "holomorphic/optimum.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <span>
#include <utility>

#include <Eigen/Eigenvalues>

#include "core/cancel.h"
#include "core/parallel.h"
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

// A descent that would have to gain so many times what its next step promises is given up.
constexpr double greatest_hope = 3.0;
// A loop whose sign is flipped has at least this share of its length as circumference.
constexpr double least_circumference = 0.1;

double exterior_period(const Eigen::VectorXd& lambda) {
  return -lambda.sum();
}

bool has_both_signs(const std::vector<int>& signs) {
  return std::any_of(signs.begin(), signs.end(), [&](int s) { return s != signs.front(); });
}

using Signs = std::vector<int>;

/// The loops of a surface, and descents from patterns of their signs.
class Descents {
 public:
  Descents(const AreaEnergy& energy, const std::vector<double>& lengths, int exterior)
      : energy_(energy), lengths_(lengths), exterior_(exterior) {}

  Descent from(const Signs& signs, const std::vector<double>& circumferences,
               double target = std::numeric_limits<double>::infinity()) const {
    Eigen::VectorXd start = balanced_start(signs, circumferences, exterior_);
    start *= energy_.along(start).best_scale();
    Descent descent = descend(energy_, start, most_descent_iterations, target);
    descent.signs = signs;
    return descent;
  }

  std::vector<Descent> from_all(const std::vector<Signs>& patterns) const {
    std::vector<Descent> descents(patterns.size());
    parallel_tasks(patterns.size(),
                   [&](std::size_t i) { descents[i] = from(patterns[i], lengths_); });
    return descents;
  }

  // Flips one sign after the other, with descents from there, as long as that lowers the energy.
  void improve(Descent& best) const {
    Signs signs = best.signs;
    int untried = static_cast<int>(signs.size());
    for (std::size_t i = 0; untried > 0; i = (i + 1) % signs.size(), --untried) {
      signs[i] = -signs[i];
      if (has_both_signs(signs)) {
        Descent descent = from(signs, circumferences(best), best.energy);
        if (descent.energy < best.energy - tolerance::energy_decrease) {
          best = std::move(descent);
          untried = static_cast<int>(signs.size());
          continue;
        }
      }
      signs[i] = -signs[i];
    }
  }

 private:
  std::vector<double> circumferences(const Descent& descent) const {
    std::vector<double> result(lengths_.size(), std::abs(exterior_period(descent.lambda)));
    for (int i = 0, k = 0; i < static_cast<int>(result.size()); ++i) {
      if (i != exterior_) result[i] = std::abs(descent.lambda[k++]);
      result[i] = std::max(result[i], least_circumference * lengths_[i]);
    }
    return result;
  }

  const AreaEnergy& energy_;
  const std::vector<double>& lengths_;
  int exterior_;
};

/// Flips and swaps signs as long as that lowers the least energy along the balanced start: the
/// gradients of sources and sinks are summed up apart, so that a trial costs a pass over the
/// triangles, whatever the number of loops.
class SignSearch {
 public:
  SignSearch(const FacewiseEnergy& energy, const std::vector<double>& lengths, int exterior,
             const SearchOptions& options, Signs signs)
      : energy_(energy),
        lengths_(lengths),
        exterior_(exterior),
        most_swaps_(options.most_swaps),
        random_(options.seed),
        signs_(std::move(signs)) {
    best_ = energy_.along(balanced_start(signs_, lengths_, exterior_)).least();
  }

  Signs run() {
    const int count = static_cast<int>(signs_.size());
    for (bool improved = true; improved;) {
      throw_if_cancelled();
      improved = false;
      sum_up();  // anew: rounding would add up
      for (int i = 0; i < count; ++i) {
        const std::array<int, 1> single{i};
        improved = try_flips(single) || improved;
        for (const int j : partners_of(i)) {
          if (signs_[i] == signs_[j]) continue;
          const std::array<int, 2> pair{i, j};
          improved = try_flips(pair) || improved;
        }
      }
    }
    // All signs turned over are the same pattern.
    if (signs_.front() < 0)
      std::transform(signs_.begin(), signs_.end(), signs_.begin(), std::negate());
    return std::move(signs_);
  }

 private:
  /// Sum over the loops of one sign.
  struct Side {
    double length = 0.0;
    Eigen::VectorXd gradients;
  };

  // Later loops, so that each pair comes once; or random ones, if these are too many.
  std::vector<int> partners_of(int loop) {
    const int count = static_cast<int>(signs_.size());
    std::vector<int> partners;
    if (count - 1 <= most_swaps_) {
      for (int j = loop + 1; j < count; ++j) partners.push_back(j);
      return partners;
    }
    for (int i = 0; i < most_swaps_; ++i) {
      partners.push_back(static_cast<int>(random_() % static_cast<std::uint64_t>(count)));
    }
    return partners;
  }

  // None for the exterior loop, whose period is that of the others.
  bool has_gradients(int loop) const { return loop != exterior_; }
  auto gradients(int loop) const {
    return energy_.gradients().col(loop < exterior_ ? loop : loop - 1);
  }

  void sum_up() {
    for (Side& side : sides_) side = {0.0, Eigen::VectorXd::Zero(energy_.gradients().rows())};
    for (int i = 0; i < static_cast<int>(signs_.size()); ++i) add(signs_[i], i, 1.0);
  }

  void add(int sign, int loop, double factor) {
    Side& side = sides_[sign > 0 ? 1 : 0];
    side.length += factor * lengths_[loop];
    if (has_gradients(loop)) side.gradients += factor * lengths_[loop] * gradients(loop);
  }

  bool try_flips(std::span<const int> loops) {
    double positive = sides_[1].length;
    for (const int loop : loops) positive -= signs_[loop] * lengths_[loop];
    const double negative = sides_[0].length + sides_[1].length - positive;
    const double least = tolerance::energy_decrease * (positive + negative);
    if (positive <= least || negative <= least) return false;  // all of one sign
    const double ratio = std::sqrt(negative / positive);
    trial_ = ratio * sides_[1].gradients - sides_[0].gradients / ratio;
    for (const int loop : loops) {
      if (!has_gradients(loop)) continue;
      trial_ -= signs_[loop] * (ratio + 1.0 / ratio) * lengths_[loop] * gradients(loop);
    }
    const double energy = energy_.along_gradients(trial_).least();
    if (energy >= best_ - tolerance::energy_decrease) return false;
    best_ = energy;
    for (const int loop : loops) {
      add(signs_[loop], loop, -1.0);
      signs_[loop] = -signs_[loop];
      add(signs_[loop], loop, 1.0);
    }
    return true;
  }

  const FacewiseEnergy& energy_;
  const std::vector<double>& lengths_;
  int exterior_;
  int most_swaps_;
  std::mt19937_64 random_;
  Signs signs_;
  double best_;
  std::array<Side, 2> sides_;  // of negative and of positive signs
  Eigen::VectorXd trial_;
};

std::vector<Signs> random_patterns(std::size_t loops, const SearchOptions& options) {
  std::mt19937_64 random(options.seed);
  std::vector<Signs> patterns;
  for (int restart = 0; restart < options.restarts; ++restart) {
    Signs signs(loops);
    do {
      for (int& s : signs) s = (random() >> 32 & 1U) != 0 ? -1 : 1;
    } while (!has_both_signs(signs));
    patterns.push_back(std::move(signs));
  }
  return patterns;
}

Eigen::VectorXd oriented(const Eigen::VectorXd& lambda) {
  Eigen::Index largest = 0;
  const double inner = lambda.cwiseAbs().maxCoeff(&largest);
  const double outer = exterior_period(lambda);
  const double decisive = std::abs(outer) > inner * (1.0 + 1e-9) ? outer : lambda[largest];
  return decisive < 0.0 ? -lambda : lambda;
}

bool has_less_energy(const Descent& a, const Descent& b) {
  return a.energy < b.energy;
}

OptimumResult best_of(std::vector<Descent> descents) {
  OptimumResult result;
  const auto best = std::min_element(descents.begin(), descents.end(), has_less_energy);
  result.best = static_cast<int>(best - descents.begin());
  result.lambda = oriented(best->lambda);
  result.energy = best->energy;
  result.descents = std::move(descents);
  return result;
}

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

Descent descend(const AreaEnergy& energy, const Eigen::VectorXd& start, int max_iterations,
                double target) {
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
    if (descent.energy - greatest_hope * predicted > target) break;
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
                           int exterior) {
  std::vector<Signs> patterns;
  for_sign_patterns(energy.size() + 1, [&](const Signs& signs) { patterns.push_back(signs); });
  return best_of(Descents(energy, loop_lengths, exterior).from_all(patterns));
}

OptimumResult search_optimal_form(const FacewiseEnergy& energy,
                                  const std::vector<double>& loop_lengths, int exterior,
                                  const SearchOptions& options) {
  std::vector<Signs> patterns = random_patterns(loop_lengths.size(), options);
  parallel_tasks(patterns.size(), [&](std::size_t i) {
    patterns[i] = SignSearch(energy, loop_lengths, exterior, options, patterns[i]).run();
  });
  std::sort(patterns.begin(), patterns.end());
  patterns.erase(std::unique(patterns.begin(), patterns.end()), patterns.end());
  const Descents descents(energy, loop_lengths, exterior);
  std::vector<Descent> all = descents.from_all(patterns);
  std::stable_sort(all.begin(), all.end(), has_less_energy);
  const auto count = std::min(all.size(), static_cast<std::size_t>(options.finalists));
  std::vector<Descent> finalists(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count));
  parallel_tasks(count, [&](std::size_t i) { descents.improve(finalists[i]); });
  all.insert(all.end(), finalists.begin(), finalists.end());
  return best_of(std::move(all));
}

}  // namespace hexwall
