#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "dec/delaunay.h"
#include "holomorphic/basis.h"
#include "holomorphic/form.h"
#include "holomorphic/optimum.h"
#include "surface/connectivity.h"
#include "surface/puncture.h"
#include "surface/triangle_surface.h"

namespace hexwall {

/// What an optimal form is asked for.
struct FormProblem {
  const TriangleSurface& surface;
  const Connectivity& connectivity;  ///< of `surface`; its loops keep their order
  const Eigen::VectorXd& edge;       ///< #F relative target edge length of each triangle
};

/// The optimal holomorphic form of a surface from which disks were taken out as poles.
struct FormSolution {
  std::vector<SurfaceDisk> disks;
  std::vector<std::vector<int>> disk_faces;  ///< per disk: triangles of the surface that it touches
  DelaunaySurface refined;    ///< without the disks; `parent_face` is of the surface itself
  Connectivity connectivity;  ///< of `refined`: the loops of the surface, then those of the disks
  std::shared_ptr<const LaplaceSolver> laplace;  ///< of `refined`; large, so let go of after use
  long factor_nonzeros = 0;                      ///< of its factor
  HolomorphicBasis basis;
  OptimumResult optimum;
  HolomorphicForm form;
  std::vector<double> scale_factor;  ///< |grad y| of each triangle of `refined`
  /// Edge of a conformal quad over its target, per triangle of `refined`, if as many quads are made
  /// as targets ask for: 1 is as wanted, above 1 too large.
  std::vector<double> size_ratio;
  double off_size_share = 0.0;  ///< share of the area where `size_ratio` is above 2 or below 1/2

  bool is_pole(int loop) const { return loop >= first_pole(); }
  int first_pole() const {
    return static_cast<int>(connectivity.loops().size()) - static_cast<int>(disks.size());
  }
};

/// Refines, computes the basis and finds the form of least energy.
FormSolution solve_form(const FormProblem& problem);

/// The same without the disks. \param punctured `problem.surface` without them.
/// \param most_negative edges that may be left non-Delaunay, as without the disks. \returns nothing
/// if more are left: the triangles around the disks stay too thin, however they are refined.
std::optional<FormSolution> solve_form(const FormProblem& problem,
                                       const std::vector<SurfaceDisk>& disks,
                                       PuncturedSurface punctured, int most_negative);

/// Sets `s.optimum`, given all that comes before it.
void find_optimum(const FormProblem& problem, FormSolution& s);

/// The factorised Laplacian of `s.refined`, once more.
std::shared_ptr<const LaplaceSolver> laplace_of(const FormSolution& s);

/// Sizing weights rho of the area energy, from relative edge lengths: squared inverse. #F.
Eigen::VectorXd sizing_weights(const Eigen::VectorXd& edge);

}  // namespace hexwall
