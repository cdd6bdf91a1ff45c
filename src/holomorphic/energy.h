#pragma once

#include <memory>
#include <vector>

#include <Eigen/Core>

#include "surface/triangle_surface.h"

namespace hexwall {

/// The area-distortion energy of a holomorphic form, normalised,
///   E(lambda) = sum_T (|T|_lambda / rho_T - |T|)^2 / sum_T |T|^2,
/// with |T|_lambda = |T| |grad y|^2, y = sum_i lambda_i g_i: the paper's quartic (4.9), corrected.
/// The sizing weight rho divides rather than multiplies as in the paper: what counts is the error
/// relative to the size wanted, or large quads would be forgotten over small ones.
/// T runs over the triangles of the *input* surface, however they were refined.
class AreaEnergy {
 public:
  virtual ~AreaEnergy() = default;
  virtual int size() const = 0;
  virtual double value(const Eigen::VectorXd& lambda) const = 0;
  /// Gradient (n) and Hessian (n x n) at `lambda`.
  virtual void derivatives(const Eigen::VectorXd& lambda, Eigen::VectorXd& gradient,
                           Eigen::MatrixXd& hessian) const = 0;

  /// The factor t that minimises E(t lambda).
  double best_scale(const Eigen::VectorXd& lambda) const;
};

/// What the energy is made of, per triangle.
struct AreaEnergyInput {
  const TriangleSurface& surface;       ///< refined surface
  const std::vector<int>& parent_face;  ///< #F triangle of the input in which each one lies,
                                        ///< -1 to leave it out
  int parent_count;                     ///< number of triangles of the input
  const Eigen::MatrixXd& g;             ///< #V x n potentials, one per circumference
  const Eigen::VectorXd& rho;           ///< #parent sizing weight, 1 = uniform
};

/// All coefficients of the quartic, gathered in one pass over the triangles: an evaluation costs
/// O(n^4), whatever the number of triangles. For n up to about 30.
std::unique_ptr<AreaEnergy> quartic_energy(const AreaEnergyInput& input);

/// The same energy evaluated triangle by triangle, O(#F n) for a value. For large n.
std::unique_ptr<AreaEnergy> facewise_energy(const AreaEnergyInput& input);

/// `input.parent_face` with all but about `count` evenly spaced triangles of the input left out.
std::vector<int> sampled_parents(const AreaEnergyInput& input, int count);

/// The cheaper of the two.
std::unique_ptr<AreaEnergy> area_energy(const AreaEnergyInput& input);

}  // namespace hexwall
