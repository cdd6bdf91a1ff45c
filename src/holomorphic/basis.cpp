#include "holomorphic/basis.h"

#include <vector>

#include "dec/laplace.h"

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

Eigen::MatrixXd differential(const Connectivity& mesh, const Eigen::MatrixXd& f) {
  Eigen::MatrixXd df(mesh.edge_count(), f.cols());
  for (int e = 0; e < mesh.edge_count(); ++e) {
    df.row(e) = f.row(mesh.tip(mesh.halfedge(e))) - f.row(mesh.tail(mesh.halfedge(e)));
  }
  return df;
}

void solve_exact_forms(const Connectivity& mesh, const Eigen::VectorXd& star1,
                       HolomorphicBasis& basis) {
  const int n = static_cast<int>(mesh.loops().size()) - 1;
  std::vector<bool> fixed(mesh.vertex_count());
  Eigen::MatrixXd boundary = Eigen::MatrixXd::Zero(mesh.vertex_count(), n);
  for (int v = 0; v < mesh.vertex_count(); ++v) fixed[v] = mesh.is_boundary_vertex(v);
  for (int i = 0; i < n; ++i) {
    for (const int v : mesh.loops()[basis.loop(i)]) boundary(v, i) = 1.0;
  }
  const LaplaceSolver solver(mesh, star1, std::move(fixed));
  basis.f = solver.solve(Eigen::MatrixXd::Zero(mesh.vertex_count(), n), boundary);
  basis.factor_nonzeros += solver.factor_nonzeros();
  const Eigen::MatrixXd df = differential(mesh, basis.f);
  basis.capacity = df.transpose() * star1.asDiagonal() * df;
}

// omega_i = eta_i + dh_i with sum_k w_jk (h_k - h_j) = -sum_k w_jk eta_i(jk) at every vertex j,
// boundary included (natural boundary condition): corrected (4.5).
void solve_periodic_forms(const Connectivity& mesh, const Eigen::VectorXd& star1,
                          HolomorphicBasis& basis) {
  const Eigen::MatrixXd eta = closed_forms_with_unit_periods(mesh, basis.exterior);
  // The constant functions are the kernel: it is removed by fixing h at one vertex.
  std::vector<bool> fixed(mesh.vertex_count(), false);
  fixed[mesh.loops()[basis.exterior].front()] = true;
  const LaplaceSolver solver(mesh, star1, std::move(fixed));
  const Eigen::MatrixXd h = solver.solve(divergence(mesh, star1, eta),
                                         Eigen::MatrixXd::Zero(mesh.vertex_count(), eta.cols()));
  basis.factor_nonzeros += solver.factor_nonzeros();
  basis.omega = eta + differential(mesh, h);
  basis.gram = basis.omega.transpose() * star1.asDiagonal() * basis.omega;
}

}  // namespace

Eigen::MatrixXd closed_forms_with_unit_periods(const Connectivity& mesh, int exterior) {
  const int n = static_cast<int>(mesh.loops().size()) - 1;
  const std::vector<int> exit = triangle_tree(mesh, exterior);
  Eigen::MatrixXd eta = Eigen::MatrixXd::Zero(mesh.edge_count(), n);
  for (int i = 0; i < n; ++i) {
    const int loop = i < exterior ? i : i + 1;
    const int entry = mesh.outgoing(mesh.loops()[loop].front());
    eta(mesh.edge(entry), i) += mesh.sign(entry);
    for (int f = Connectivity::face(entry);;) {
      const int h = exit[f];
      eta(mesh.edge(h), i) -= mesh.sign(h);
      if (mesh.twin(h) < 0) break;
      f = Connectivity::face(mesh.twin(h));
    }
  }
  return eta;
}

double period(const Connectivity& mesh, const OneForm& omega, int loop) {
  double sum = 0.0;
  for (const int v : mesh.loops()[loop]) sum += omega.along(mesh, mesh.outgoing(v));
  return sum;
}

HolomorphicBasis holomorphic_basis(const Connectivity& mesh, const Eigen::VectorXd& star1,
                                   int exterior) {
  HolomorphicBasis basis;
  basis.exterior = exterior;
  solve_exact_forms(mesh, star1, basis);
  solve_periodic_forms(mesh, star1, basis);
  const int n = basis.size();
  basis.error =
      (basis.gram * basis.capacity - Eigen::MatrixXd::Identity(n, n)).cwiseAbs().maxCoeff();
  return basis;
}

}  // namespace hexwall
