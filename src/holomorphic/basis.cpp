#include "holomorphic/basis.h"

#include <utility>
#include <vector>

namespace hexwall {
namespace {

// Breadth-first tree of triangles, rooted at those that touch the exterior loop. `exit[f]` is the
// half-edge of f through which the way to the exterior loop leaves f.
std::vector<int> triangle_tree(const Connectivity& mesh, int exterior) {
  std::vector<int> exit(mesh.face_count(), -1);
  std::vector<int> queue;
  for (const int v : mesh.loops()[exterior]) {
    const int h = mesh.outgoing(v);
    if (exit[Connectivity::face(h)] >= 0) continue;
    exit[Connectivity::face(h)] = h;
    queue.push_back(Connectivity::face(h));
  }
  for (std::size_t i = 0; i < queue.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      const int twin = mesh.twin(3 * queue[i] + k);
      if (twin < 0 || exit[Connectivity::face(twin)] >= 0) continue;
      exit[Connectivity::face(twin)] = twin;
      queue.push_back(Connectivity::face(twin));
    }
  }
  return exit;
}

// L applied to 0-forms' differentials: divergence sum_k w_jk eta(j -> k) at every vertex j.
Eigen::MatrixXd divergence(const Connectivity& mesh, const Eigen::VectorXd& star1,
                           const Eigen::MatrixXd& eta) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(mesh.vertex_count(), eta.cols());
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const int h = mesh.halfedge(e);
    result.row(mesh.tail(h)) += star1[e] * eta.row(e);
    result.row(mesh.tip(h)) -= star1[e] * eta.row(e);
  }
  return result;
}

void add_differential(const Connectivity& mesh, const Eigen::MatrixXd& f, Eigen::MatrixXd& eta) {
  for (int e = 0; e < mesh.edge_count(); ++e) {
    eta.row(e) += f.row(mesh.tip(mesh.halfedge(e))) - f.row(mesh.tail(mesh.halfedge(e)));
  }
}

// C_ij, integral of df_i ^ star df_j, by Green's formula: what flows out of loop j, the sum of L
// f_i over its vertices. Only edges at the boundary count.
Eigen::MatrixXd capacity_of(const Connectivity& mesh, const Eigen::VectorXd& star1,
                            const HolomorphicBasis& basis) {
  std::vector<int> element(mesh.loops().size(), -1);
  for (int i = 0; i < basis.size(); ++i) element[basis.loop(i)] = i;
  Eigen::MatrixXd outflow = Eigen::MatrixXd::Zero(basis.size(), basis.size());
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const int a = mesh.tail(mesh.halfedge(e));
    const int b = mesh.tip(mesh.halfedge(e));
    if (mesh.loop_of_vertex(a) == mesh.loop_of_vertex(b)) continue;
    for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, a}}) {
      const int loop = mesh.loop_of_vertex(from);
      if (loop < 0 || element[loop] < 0) continue;
      outflow.col(element[loop]) += star1[e] * (basis.f.row(from) - basis.f.row(to)).transpose();
    }
  }
  return 0.5 * (outflow + outflow.transpose());
}

}  // namespace

Eigen::MatrixXd closed_forms(const Connectivity& mesh, int exterior,
                             const Eigen::MatrixXd& lambda) {
  const std::vector<int> exit = triangle_tree(mesh, exterior);
  Eigen::MatrixXd eta = Eigen::MatrixXd::Zero(mesh.edge_count(), lambda.cols());
  for (int i = 0; i < lambda.rows(); ++i) {
    const int loop = i < exterior ? i : i + 1;
    const int entry = mesh.outgoing(mesh.loops()[loop].front());
    eta.row(mesh.edge(entry)) += mesh.sign(entry) * lambda.row(i);
    for (int f = Connectivity::face(entry);;) {
      const int h = exit[f];
      eta.row(mesh.edge(h)) -= mesh.sign(h) * lambda.row(i);
      if (mesh.twin(h) < 0) break;
      f = Connectivity::face(mesh.twin(h));
    }
  }
  return eta;
}

Eigen::MatrixXd coclosed(const Connectivity& mesh, const LaplaceSolver& laplace,
                         Eigen::MatrixXd eta) {
  const Eigen::MatrixXd h = laplace.solve_neumann(divergence(mesh, laplace.star1(), eta));
  add_differential(mesh, h, eta);
  return eta;
}

double period(const Connectivity& mesh, const OneForm& omega, int loop) {
  double sum = 0.0;
  for (const int v : mesh.loops()[loop]) sum += omega.along(mesh, mesh.outgoing(v));
  return sum;
}

HolomorphicBasis holomorphic_basis(const Connectivity& mesh, const LaplaceSolver& laplace,
                                   int exterior) {
  HolomorphicBasis basis;
  basis.exterior = exterior;
  const int n = static_cast<int>(mesh.loops().size()) - 1;
  Eigen::MatrixXd boundary = Eigen::MatrixXd::Zero(mesh.vertex_count(), n);
  for (int i = 0; i < n; ++i) {
    for (const int v : mesh.loops()[basis.loop(i)]) boundary(v, i) = 1.0;
  }
  basis.f = laplace.harmonic_extension(boundary);
  basis.capacity = capacity_of(mesh, laplace.star1(), basis);
  return basis;
}

PeriodicForms periodic_forms(const Connectivity& mesh, const LaplaceSolver& laplace,
                             const HolomorphicBasis& basis) {
  const int n = basis.size();
  const Eigen::MatrixXd unit = Eigen::MatrixXd::Identity(n, n);
  PeriodicForms forms;
  forms.omega = coclosed(mesh, laplace, closed_forms(mesh, basis.exterior, unit));
  forms.gram = forms.omega.transpose() * laplace.star1().asDiagonal() * forms.omega;
  forms.error = (forms.gram * basis.capacity - unit).cwiseAbs().maxCoeff();
  return forms;
}

}  // namespace hexwall
