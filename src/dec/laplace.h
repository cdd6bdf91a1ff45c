#pragma once

#include <memory>
#include <vector>

#include <Eigen/Core>

#include "surface/connectivity.h"

namespace hexwall {

/// The sparse Cholesky factor of a weighted graph Laplacian d0^T star1 d0 with the rows and columns
/// of fixed vertices removed. Factorised once, then solves any number of right-hand sides.
class LaplaceSolver {
 public:
  /// \param star1 #E cotangent weights, as of `star1`.
  /// \param fixed #V, true where the solution is given. At least one vertex.
  /// \throws Error(internal) if the matrix is not positive definite.
  LaplaceSolver(const Connectivity& mesh, const Eigen::VectorXd& star1, std::vector<bool> fixed);
  ~LaplaceSolver();
  LaplaceSolver(LaplaceSolver&&) noexcept;
  LaplaceSolver& operator=(LaplaceSolver&&) noexcept;

  /// Solves L u = rhs at the free vertices, with u = `boundary` at the fixed ones.
  /// \param rhs, boundary #V x k; rows of fixed vertices in `rhs` and of free ones in `boundary`
  /// are ignored.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& rhs, const Eigen::MatrixXd& boundary) const;

  /// Number of nonzeros of the factor.
  long factor_nonzeros() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace hexwall
