#pragma once

#include <Eigen/Core>

#include "dec/one_form.h"
#include "surface/connectivity.h"
#include "surface/triangle_surface.h"

namespace hexwall {

/// A basis of the holomorphic 1-forms phi_i = omega_i + i * star(omega_i) of a poly-annulus with
/// loops 0 … n. "Optimal Surface Quadrilateral Mesh Generation", section 4, with the corrections
/// that src/README.md lists.
struct HolomorphicBasis {
  int exterior = 0;  ///< the loop on which every f_i vanishes

  /// #V x n. f_i is harmonic, 1 on the i-th loop other than the exterior one, 0 on all others.
  /// df_i are the exact harmonic forms.
  Eigen::MatrixXd f;

  /// #E x n. omega_i is closed and co-closed, with period 1 around the i-th loop (traversed with
  /// the surface on its left), -1 around the exterior one and 0 around the others.
  Eigen::MatrixXd omega;

  Eigen::MatrixXd capacity;  ///< n x n, C_ij = integral of df_i ^ star df_j, dimensionless
  Eigen::MatrixXd gram;      ///< n x n, lambda_ij = integral of omega_i ^ star omega_j:
                             ///< star omega_i = -sum_j lambda_ij df_j (corrected (4.7))

  /// max |Gram * Capacity - I|: zero in the smooth limit. Both matrices are Dirichlet energies of
  /// trial functions, hence bounds from above for a matrix and its inverse: together they enclose
  /// the exact moduli, and this is the width of the enclosure.
  double error = 0.0;

  long factor_nonzeros = 0;  ///< of the two Cholesky factors together

  int size() const { return static_cast<int>(f.cols()); }
  /// The loop of basis element `i`.
  int loop(int i) const { return i < exterior ? i : i + 1; }
  OneForm omega_form(int i) const { return {omega.col(i)}; }
};

/// Computes the basis: one Dirichlet and one Neumann factorisation, 2 n right-hand sides.
/// \param star1 #E cotangent weights of `mesh`, as of `star1`.
/// \param exterior any loop: the space of forms does not depend on it.
/// \pre genus 0, at least two loops.
HolomorphicBasis holomorphic_basis(const Connectivity& mesh, const Eigen::VectorXd& star1,
                                   int exterior = 0);

/// Closed 1-forms eta_i with the periods of omega_i: unit flows from loop i to the exterior loop
/// along a spanning tree of triangles, hence exactly closed. #E x n.
Eigen::MatrixXd closed_forms_with_unit_periods(const Connectivity& mesh, int exterior);

/// Integral of a 1-form around a loop, traversed with the surface on its left.
double period(const Connectivity& mesh, const OneForm& omega, int loop);

}  // namespace hexwall
