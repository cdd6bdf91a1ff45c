#include "dec/laplace.h"

#include <utility>

#include <Eigen/CholmodSupport>
#include <Eigen/SparseCore>

#include "core/errors.h"

namespace hexwall {

struct LaplaceSolver::Implementation {
  using Matrix = Eigen::SparseMatrix<double>;

  std::vector<int> free_vertices;  // row of the reduced matrix -> vertex
  std::vector<bool> fixed;
  Matrix coupling;  // free x #V block that multiplies the fixed values
  // Simplicial: measured faster than supernodal at these sizes, and independent of BLAS threads.
  Eigen::CholmodSimplicialLLT<Matrix, Eigen::Lower> factor;

  void assemble(const Connectivity& mesh, const Eigen::VectorXd& star1);
};

void LaplaceSolver::Implementation::assemble(const Connectivity& mesh,
                                             const Eigen::VectorXd& star1) {
  std::vector<int> row(mesh.vertex_count(), -1);
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    if (fixed[v] || mesh.outgoing(v) < 0) continue;
    row[v] = static_cast<int>(free_vertices.size());
    free_vertices.push_back(v);
  }
  const int size = static_cast<int>(free_vertices.size());
  coupling.resize(size, mesh.vertex_count());
  if (size == 0) return;  // CHOLMOD takes no empty matrices
  std::vector<Eigen::Triplet<double>> inner;
  std::vector<Eigen::Triplet<double>> outer;
  inner.reserve(3 * mesh.edge_count());
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const int a = mesh.tail(mesh.halfedge(e));
    const int b = mesh.tip(mesh.halfedge(e));
    const double w = star1[e];
    if (row[a] >= 0) inner.emplace_back(row[a], row[a], w);
    if (row[b] >= 0) inner.emplace_back(row[b], row[b], w);
    if (row[a] >= 0 && row[b] >= 0) {
      inner.emplace_back(std::max(row[a], row[b]), std::min(row[a], row[b]), -w);
    } else if (row[a] >= 0) {
      outer.emplace_back(row[a], b, w);
    } else if (row[b] >= 0) {
      outer.emplace_back(row[b], a, w);
    }
  }
  Matrix matrix(size, size);
  matrix.setFromTriplets(inner.begin(), inner.end());
  coupling.setFromTriplets(outer.begin(), outer.end());
  factor.cholmod().print = 0;  // failures are thrown, not printed
  factor.compute(matrix);
  if (factor.info() != Eigen::Success) {
    throw Error(ExitCode::internal, "the Laplacian of the surface is not positive definite");
  }
}

LaplaceSolver::LaplaceSolver(const Connectivity& mesh, const Eigen::VectorXd& star1,
                             std::vector<bool> fixed)
    : implementation_(std::make_unique<Implementation>()) {
  implementation_->fixed = std::move(fixed);
  implementation_->assemble(mesh, star1);
}

LaplaceSolver::~LaplaceSolver() = default;
LaplaceSolver::LaplaceSolver(LaplaceSolver&&) noexcept = default;
LaplaceSolver& LaplaceSolver::operator=(LaplaceSolver&&) noexcept = default;

Eigen::MatrixXd LaplaceSolver::solve(const Eigen::MatrixXd& rhs,
                                     const Eigen::MatrixXd& boundary) const {
  const Implementation& s = *implementation_;
  if (s.free_vertices.empty()) return boundary;
  Eigen::MatrixXd reduced = s.coupling * boundary;
  const int size = static_cast<int>(s.free_vertices.size());
  for (int i = 0; i < size; ++i) reduced.row(i) += rhs.row(s.free_vertices[i]);
  const Eigen::MatrixXd inner = s.factor.solve(reduced);
  Eigen::MatrixXd solution = boundary;
  for (int i = 0; i < size; ++i) solution.row(s.free_vertices[i]) = inner.row(i);
  return solution;
}

long LaplaceSolver::factor_nonzeros() const {
  if (implementation_->free_vertices.empty()) return 0;
  return static_cast<long>(implementation_->factor.cholmod().lnz);
}

}  // namespace hexwall
