#pragma once

#include <memory>

#include <Eigen/Core>

#include "surface/connectivity.h"

namespace hexwall {

/// The sparse Cholesky factor of the weighted graph Laplacian L = d0^T star1 d0 of a mesh with
/// boundary. Boundary vertices are eliminated last: the leading block is then the factor of the
/// Dirichlet problem, and all of it that of the Neumann problem, so that one factorisation serves
/// both. Solves any number of right-hand sides, in blocks, in parallel.
class LaplaceSolver {
 public:
  /// \param star1 #E cotangent weights, as of `star1`.
  /// \throws GeometryError if the matrix is not positive definite but for the constants.
  LaplaceSolver(const Connectivity& mesh, Eigen::VectorXd star1);
  ~LaplaceSolver();
  LaplaceSolver(LaplaceSolver&&) noexcept;
  LaplaceSolver& operator=(LaplaceSolver&&) noexcept;

  /// The functions with L u = rhs at interior vertices and u = 0 at the boundary. Quickest where
  /// each column of rhs is zero but for some vertices.
  /// \param rhs #V x k; its rows of boundary vertices are ignored.
  Eigen::MatrixXd solve_dirichlet(const Eigen::MatrixXd& rhs) const;

  /// The functions with L u = 0 at interior vertices that are `boundary` at the boundary.
  /// \param boundary #V x k; its rows of interior vertices are ignored.
  Eigen::MatrixXd harmonic_extension(const Eigen::MatrixXd& boundary) const;

  /// The functions with L u = rhs at every vertex, which is the natural boundary condition, and
  /// u = 0 at the first vertex of the first loop. \param rhs #V x k, each column summing to zero.
  Eigen::MatrixXd solve_neumann(const Eigen::MatrixXd& rhs) const;

  /// Number of nonzeros of the factor.
  long factor_nonzeros() const;
  const Eigen::VectorXd& star1() const;  ///< #E

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace hexwall
