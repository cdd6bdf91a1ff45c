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

  /// a and b of E(t lambda) = a t^4 - 2 b t^2 + 1.
  struct Ray {
    double a, b;
    double best_scale() const;  ///< the t of least energy
    double least() const;       ///< the energy there
  };
  virtual Ray along(const Eigen::VectorXd& lambda) const = 0;
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

/// Up to as many unknowns the n^4 coefficients cost less than the triangles they replace.
inline constexpr int largest_quartic = 30;

/// All coefficients of the quartic, gathered in one pass over the triangles: an evaluation costs
/// O(n^4), whatever the number of triangles. For n up to `largest_quartic`.
std::unique_ptr<AreaEnergy> quartic_energy(const AreaEnergyInput& input);

/// The same energy evaluated triangle by triangle, O(#F n) for a value. For large n.
class FacewiseEnergy final : public AreaEnergy {
 public:
  explicit FacewiseEnergy(const AreaEnergyInput& input);

  int size() const override { return static_cast<int>(gradients_.cols()); }
  double value(const Eigen::VectorXd& lambda) const override;
  void derivatives(const Eigen::VectorXd& lambda, Eigen::VectorXd& gradient,
                   Eigen::MatrixXd& hessian) const override;
  Ray along(const Eigen::VectorXd& lambda) const override;

  /// Gradients of the potentials on the triangles, two components each, scaled such that those of
  /// lambda, `gradients() * lambda`, have the triangle's |T|_lambda / rho as squared length.
  const Eigen::MatrixXd& gradients() const { return gradients_; }
  /// `along` the lambda with these gradients.
  Ray along_gradients(const Eigen::VectorXd& y) const;

 private:
  Eigen::VectorXd images(const Eigen::VectorXd& y) const;  // |T|_lambda / rho of the parents

  std::vector<int> parent_face_;  // of each triangle
  Eigen::MatrixXd gradients_;
  Eigen::VectorXd areas_;  // of the parents
  double scale_ = 1.0;
};

/// `input.parent_face` with all but about `count` evenly spaced triangles of the input left out.
std::vector<int> sampled_parents(const AreaEnergyInput& input, int count);

/// The cheaper of the two.
std::unique_ptr<AreaEnergy> area_energy(const AreaEnergyInput& input);

}  // namespace hexwall
