#pragma once

#include <Eigen/Core>

#include "dec/laplace.h"
#include "dec/one_form.h"
#include "surface/connectivity.h"

namespace hexwall {

/// A basis of the holomorphic 1-forms phi_i = omega_i + i * star(omega_i) of a poly-annulus with
/// loops 0 … n, given by the harmonic functions of its imaginary parts. "Optimal Surface
/// Quadrilateral Mesh Generation", section 4, with the corrections that src/README.md lists. The
/// area |phi|^2 = |grad y|^2 needs no omega_i, and the form chosen has its own x (`combine`);
/// `periodic_forms` gives all of them.
struct HolomorphicBasis {
  int exterior = 0;  ///< the loop on which every f_i vanishes

  /// #V x n. f_i is harmonic, 1 on the i-th loop other than the exterior one, 0 on all others.
  /// df_i are the exact harmonic forms.
  Eigen::MatrixXd f;

  Eigen::MatrixXd capacity;  ///< n x n, C_ij = integral of df_i ^ star df_j, dimensionless

  int size() const { return static_cast<int>(f.cols()); }
  /// The loop of basis element `i`.
  int loop(int i) const { return i < exterior ? i : i + 1; }
};

/// Computes the basis: n right-hand sides of the Dirichlet problem.
/// \param exterior any loop: the space of forms does not depend on it.
/// \pre genus 0, at least two loops.
HolomorphicBasis holomorphic_basis(const Connectivity& mesh, const LaplaceSolver& laplace,
                                   int exterior = 0);

/// The closed and co-closed forms of unit periods.
struct PeriodicForms {
  /// #E x n. omega_i has period 1 around the i-th loop (traversed with the surface on its left), -1
  /// around the exterior one and 0 around the others.
  Eigen::MatrixXd omega;

  Eigen::MatrixXd gram;  ///< n x n, lambda_ij = integral of omega_i ^ star omega_j:
                         ///< star omega_i = -sum_j lambda_ij df_j (corrected (4.7))

  /// max |Gram * Capacity - I|: zero in the smooth limit. Both matrices are Dirichlet energies of
  /// trial functions, hence bounds from above for a matrix and its inverse: together they enclose
  /// the exact moduli, and this is the width of the enclosure.
  double error = 0.0;

  OneForm form(int i) const { return {omega.col(i)}; }
};

/// Computes them: n right-hand sides of the Neumann problem.
PeriodicForms periodic_forms(const Connectivity& mesh, const LaplaceSolver& laplace,
                             const HolomorphicBasis& basis);

/// The co-closed forms of the cohomology classes of closed forms `eta`, #E x k: eta + dh with
/// sum_k w_jk (h_k - h_j) = -sum_k w_jk eta(jk) at every vertex j, boundary included (natural
/// boundary condition): corrected (4.5).
Eigen::MatrixXd coclosed(const Connectivity& mesh, const LaplaceSolver& laplace,
                         Eigen::MatrixXd eta);

/// A closed 1-form with the periods of sum_i lambda_i omega_i, for each column of `lambda`, n x k:
/// flows from the loops to the exterior loop along a spanning tree of triangles, hence exactly
/// closed. #E x k.
Eigen::MatrixXd closed_forms(const Connectivity& mesh, int exterior, const Eigen::MatrixXd& lambda);

/// Integral of a 1-form around a loop, traversed with the surface on its left.
double period(const Connectivity& mesh, const OneForm& omega, int loop);

}  // namespace hexwall
