#pragma once

#include <vector>

#include "holomorphic/solution.h"

namespace hexwall {

/// One pole and what it changed.
struct PoleStep {
  SurfaceDisk disk;
  double energy_before = 0.0, energy_after = 0.0;        ///< normalised area energy
  double off_share_before = 0.0, off_share_after = 0.0;  ///< `FormSolution::off_size_share`
};

struct PoleOptions {
  int most = 3;                    ///< greatest number of poles
  bool only_if_worthwhile = true;  ///< false: `most` poles, wherever they help most
  /// A pole is worthwhile where quads are more than twice too large on this share of the area …
  double least_blind_share = 0.03;
  /// … and if the energy falls by this fraction.
  double least_gain = 0.25;
  int candidates = 40;
};

struct PoleResult {
  FormSolution solution;
  std::vector<PoleStep> poles;
};

/// Punctures blind regions (the domes of saccular aneurysms), where the scale of the form decays
/// exponentially and quads come out far too large: greedily, as long as the energy falls enough.
///
/// Candidates are farthest-point samples of the region where quads would be more than twice too
/// large. Each is judged without being punctured: a point charge there is one more right-hand side
/// of the Dirichlet factorisation, and its potential one more unknown of the quartic energy, from
/// which the charge's immediate neighbourhood is left out. The best one is refined locally. The
/// hole is then as large as the charge asks for: its circumference is that of the form, |lambda|,
/// where rings of quads around it have their proper size; less where that is no disk, or where the
/// form would have half-zeros on its loop.
///
/// Where no single pole is worthwhile, two at once are tried: a sac on a narrow neck needs a source
/// and a sink of its own, since no flux through the neck can fill it.
PoleResult place_poles(const FormProblem& problem, FormSolution start, const PoleOptions& options);

/// Puts poles at the vertices nearest to given places.
/// \throws UsageError if one of them is far away from the surface, or has no room for a pole.
PoleResult place_poles_at(const FormProblem& problem, FormSolution start,
                          const std::vector<Vec3>& places);

}  // namespace hexwall
