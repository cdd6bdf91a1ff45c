#pragma once

#include <Eigen/Core>

#include "dec/one_form.h"
#include "holomorphic/basis.h"

namespace hexwall {

/// A holomorphic 1-form dx + i dy on a poly-annulus. With J the counter-clockwise quarter turn seen
/// from outside, grad y = J grad x: walking towards +x, +y lies on the left.
struct HolomorphicForm {
  Eigen::VectorXd y;        ///< #V, constant on every boundary loop; length unit of the input
  OneForm dx;               ///< #E
  Eigen::VectorXd periods;  ///< n+1 periods of x around the loops, surface on the left; they sum
                            ///< to zero, positive where y rises from the loop into the surface
  /// Dirichlet energy of x over that of y, minus one: 0 in the smooth limit, where both are the
  /// area of the image, and never below, for that area lies between them.
  double error = 0.0;
};

/// The potentials g_i with y = sum_i lambda_i g_i: g = -f Capacity^-1. #V x n.
Eigen::MatrixXd potentials(const HolomorphicBasis& basis);

/// The form sum_i lambda_i (omega_i + i dg_i): one right-hand side of the Neumann problem.
HolomorphicForm combine(const Connectivity& mesh, const LaplaceSolver& laplace,
                        const HolomorphicBasis& basis, const Eigen::VectorXd& lambda);

}  // namespace hexwall
