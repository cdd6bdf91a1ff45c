#pragma once

#include <memory>

#include <Eigen/Core>

#include "surface/connectivity.h"

namespace hexwall::bench {

/// What the forms cost at the least if both problems are factorised: CHOLMOD alone, its matrices of
/// the Dirichlet and the Neumann problem already assembled. The reference of the stage "forms".
class BareCholmod {
 public:
  BareCholmod(const Connectivity& mesh, const Eigen::VectorXd& star1);
  ~BareCholmod();
  BareCholmod(const BareCholmod&) = delete;
  BareCholmod& operator=(const BareCholmod&) = delete;

  /// Analyses and factorises both matrices and solves a block of n right-hand sides with each.
  /// \return nonzeros of both factors.
  double run(int n);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace hexwall::bench
