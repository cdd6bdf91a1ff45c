#pragma once

#include <memory>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "dec/operators.h"
#include "holomorphic/basis.h"
#include "holomorphic/energy.h"
#include "holomorphic/form.h"
#include "holomorphic/optimum.h"
#include "support/vessel_surfaces.h"

namespace hexwall::test {

/// A surface with its holomorphic forms.
struct Harmonic {
  DelaunaySurface refined;
  int input_faces = 0;
  Connectivity mesh;
  Eigen::VectorXd star;
  std::shared_ptr<const LaplaceSolver> laplace;
  HolomorphicBasis basis;
  PeriodicForms periodic;
  Eigen::MatrixXd g;

  const TriangleSurface& surface() const { return refined.surface; }
  int n() const { return basis.size(); }
  HolomorphicForm form(const Eigen::VectorXd& lambda) const {
    return combine(mesh, *laplace, basis, lambda);
  }
};

inline Harmonic harmonic(const TriangleSurface& input, int exterior = 0) {
  Harmonic h;
  h.refined = delaunay_of(input);
  h.input_faces = static_cast<int>(input.triangles.size());
  h.mesh = connectivity_of(h.refined.surface);
  h.star = star1(h.refined.surface, h.mesh);
  h.laplace = std::make_shared<const LaplaceSolver>(h.mesh, h.star);
  h.basis = holomorphic_basis(h.mesh, *h.laplace, exterior);
  h.periodic = periodic_forms(h.mesh, *h.laplace, h.basis);
  h.g = potentials(h.basis);
  return h;
}

inline std::unique_ptr<AreaEnergy> energy_of(const Harmonic& h) {
  const Eigen::VectorXd rho = Eigen::VectorXd::Ones(h.input_faces);
  return area_energy({h.surface(), h.refined.parent_face, h.input_faces, h.g, rho});
}

inline OptimumResult optimum_of(const Harmonic& h) {
  return optimal_form(*energy_of(h), loop_lengths(h.surface(), h.mesh), h.basis.exterior);
}

inline OptimumResult searched_optimum_of(const Harmonic& h, const SearchOptions& options = {}) {
  const Eigen::VectorXd rho = Eigen::VectorXd::Ones(h.input_faces);
  const FacewiseEnergy energy({h.surface(), h.refined.parent_face, h.input_faces, h.g, rho});
  return search_optimal_form(energy, loop_lengths(h.surface(), h.mesh), h.basis.exterior, options);
}

/// Gradient on triangle `f` of the function whose differences along two half-edges of the triangle,
/// 3 f and 3 f + 1, are given.
inline Vec3 gradient(const TriangleSurface& surface, int f, double along_first,
                     double along_second) {
  const auto& [a, b, c] = surface.triangles[f];
  const Vec3 u = surface.points[b] - surface.points[a];
  const Vec3 v = surface.points[c] - surface.points[b];
  const Vec3 normal = doubled_area_vector(surface, f);
  return (along_first * v.cross(normal) + along_second * normal.cross(u)) / normal.squaredNorm();
}

inline Vec3 gradient(const TriangleSurface& surface, const Connectivity& mesh, const OneForm& omega,
                     int f) {
  return gradient(surface, f, omega.along(mesh, 3 * f), omega.along(mesh, 3 * f + 1));
}

inline Vec3 gradient(const TriangleSurface& surface, const Eigen::VectorXd& y, int f) {
  const auto& [a, b, c] = surface.triangles[f];
  return gradient(surface, f, y[b] - y[a], y[c] - y[b]);
}

/// ||grad y - J grad x|| / ||grad y|| in L2, J the quarter turn counter-clockwise from outside.
inline double cauchy_riemann_defect(const Harmonic& h, const HolomorphicForm& form) {
  double defect = 0.0;
  double norm = 0.0;
  for (int f = 0; f < h.mesh.face_count(); ++f) {
    const Vec3 normal = doubled_area_vector(h.surface(), f);
    const Vec3 turned = normal.normalized().cross(gradient(h.surface(), h.mesh, form.dx, f));
    const Vec3 dy = gradient(h.surface(), form.y, f);
    defect += normal.norm() * (dy - turned).squaredNorm();
    norm += normal.norm() * dy.squaredNorm();
  }
  return std::sqrt(defect / norm);
}

}  // namespace hexwall::test
