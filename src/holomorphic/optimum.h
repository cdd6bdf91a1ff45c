#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "holomorphic/energy.h"

namespace hexwall {

/// Above as many circumferences not every sign pattern is tried.
inline constexpr int most_for_every_pattern = 12;
inline constexpr int most_descent_iterations = 200;

struct SearchOptions {
  int restarts = 16;       ///< random sign patterns to start from
  int finalists = 1;       ///< minima that are improved by descents with one sign flipped
  int most_swaps = 64;     ///< loops with which each one is tried to be swapped, at random if fewer
                           ///< than all
  std::uint64_t seed = 1;  ///< of the random choices
};

/// One descent: from a sign pattern to a local minimum.
struct Descent {
  std::vector<int> signs;          ///< n+1, the sign of each loop's circumference
  double energy = 0.0;             ///< normalised energy at the end
  std::vector<double> iterations;  ///< energy after each iteration, never rising
  Eigen::VectorXd lambda;          ///< n circumferences at the end
};

struct OptimumResult {
  Eigen::VectorXd lambda;         ///< n circumferences (signed periods), in the input's length unit
  double energy = 0.0;            ///< normalised
  std::vector<Descent> descents;  ///< one per start, in order of the starts
  int best = 0;                   ///< index of the winner in `descents`
};

/// The form of least energy, by trust-region Newton descents from |lambda_i| = length of loop i
/// with every pattern of signs (a loop can be a source or a sink): E has one family of local minima
/// per pattern. Patterns run over all n+1 loops and are balanced so that the periods sum to zero;
/// the choice of the exterior loop therefore does not matter. The sign of the result is fixed: the
/// circumference of greatest magnitude among all loops is positive. Descents run in parallel; the
/// result does not depend on the number of threads.
/// \param loop_lengths n+1 lengths; basis element i belongs to loop i < exterior ? i : i + 1.
OptimumResult optimal_form(const AreaEnergy& energy, const std::vector<double>& loop_lengths,
                           int exterior);

/// A form of low energy where there are too many patterns to try them all. From random patterns,
/// flips of one sign and swaps of two opposite ones are taken as long as they lower the energy of
/// the start of a descent, which costs next to nothing; descents follow from the patterns found,
/// and descents from the best minima with one sign flipped.
OptimumResult search_optimal_form(const FacewiseEnergy& energy,
                                  const std::vector<double>& loop_lengths, int exterior,
                                  const SearchOptions& options = {});

/// Calls visit(signs) for every pattern of the signs of `loops` loops in which both occur. The sign
/// of the first one stays +1: E(-lambda) = E(lambda).
template <typename Visit>
void for_sign_patterns(int loops, Visit visit) {
  for (unsigned pattern = 1; pattern < (1U << (loops - 1)); ++pattern) {
    std::vector<int> signs(loops, 1);
    for (int i = 1; i < loops; ++i) signs[i] = (pattern >> (i - 1) & 1U) != 0 ? -1 : 1;
    visit(signs);
  }
}

/// Circumferences proportional to the loops' lengths, with the signs given, those of either sign
/// scaled such that they sum to zero over all loops: the start of a descent. Size n, without the
/// exterior loop. \param signs, lengths n+1; both signs occur.
Eigen::VectorXd balanced_start(const std::vector<int>& signs, const std::vector<double>& lengths,
                               int exterior);

/// A trust-region Newton descent from `start`; `iterations` of the result starts with E(start).
/// \param target it is given up where it does not look like falling below that.
Descent descend(const AreaEnergy& energy, const Eigen::VectorXd& start, int max_iterations,
                double target = std::numeric_limits<double>::infinity());

}  // namespace hexwall
