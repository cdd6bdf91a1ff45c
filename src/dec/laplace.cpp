#include "dec/laplace.h"

#include <algorithm>
#include <cholmod.h>
#include <numeric>
#include <utility>
#include <vector>

#include "core/errors.h"
#include "core/parallel.h"

namespace hexwall {
namespace {

// Right-hand sides are solved by as many; CHOLMOD itself takes four at a time.
constexpr Eigen::Index block_columns = 4;

/// CHOLMOD's workspace. Not for two threads at once.
class Workspace {
 public:
  Workspace() {
    cholmod_start(&common_);
    common_.print = 0;  // failures are thrown, not printed
    // Measured faster than supernodal at these sizes, and independent of the BLAS.
    common_.supernodal = CHOLMOD_SIMPLICIAL;
    common_.final_ll = 1;
  }
  ~Workspace() { cholmod_finish(&common_); }
  Workspace(const Workspace&) = delete;
  Workspace& operator=(const Workspace&) = delete;

  cholmod_common* get() { return &common_; }

 private:
  cholmod_common common_;
};

template <auto free_object>
struct Free {
  cholmod_common* common;
  template <class T>
  void operator()(T* object) const {
    free_object(&object, common);
  }
};
using Sparse = std::unique_ptr<cholmod_sparse, Free<cholmod_free_sparse>>;
using Factor = std::unique_ptr<cholmod_factor, Free<cholmod_free_factor>>;
using Dense = std::unique_ptr<cholmod_dense, Free<cholmod_free_dense>>;

/// Takes over one of CHOLMOD's objects.
template <class Owner>
Owner owned(typename Owner::pointer object, Workspace& workspace) {
  if (object == nullptr) {
    throw Error(ExitCode::internal, "no memory left to solve for harmonic functions");
  }
  return Owner(object, {workspace.get()});
}

cholmod_dense as_dense(Eigen::MatrixXd& matrix) {
  const auto rows = static_cast<std::size_t>(matrix.rows());
  const auto columns = static_cast<std::size_t>(matrix.cols());
  return {rows,          columns, rows * columns, rows,
          matrix.data(), nullptr, CHOLMOD_REAL,   CHOLMOD_DOUBLE};
}

}  // namespace

struct LaplaceSolver::Implementation {
  Eigen::VectorXd star1;
  std::vector<int> vertices;  // row of the matrix -> vertex: the interior, then the boundary
  int interior = 0;           // rows of interior vertices
  struct Coupling {
    int interior, boundary;  // vertices of an edge
    double weight;
  };
  std::vector<Coupling> coupling;
  Workspace workspace;
  Factor factor{nullptr, {}};
  std::vector<int> order;     // row of the factor -> vertex
  std::vector<int> boundary;  // all boundary vertices
  long nonzeros = 0;

  void number_rows(const Connectivity& mesh);
  Sparse assemble(const Connectivity& mesh);
  void factorise(const Sparse& matrix);
  // How to solve: in the interior only, and with right-hand sides that are zero nearly everywhere.
  struct Task {
    bool dirichlet;
    bool is_sparse;
  };
  // Solves for the columns of `x`, #V x k, in place; rows that are none of the matrix become zero.
  void solve(Eigen::MatrixXd& x, Task task) const;
  void solve_block(Eigen::Ref<Eigen::MatrixXd> x, Task task) const;
  void forward_substitution(Eigen::Ref<Eigen::VectorXd> x) const;
};

void LaplaceSolver::Implementation::number_rows(const Connectivity& mesh) {
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.outgoing(v) >= 0 && !mesh.is_boundary_vertex(v)) vertices.push_back(v);
  }
  interior = static_cast<int>(vertices.size());
  for (const auto& loop : mesh.loops()) boundary.insert(boundary.end(), loop.begin(), loop.end());
  // The constants are the kernel: it is removed by fixing the first vertex.
  if (!boundary.empty()) vertices.insert(vertices.end(), boundary.begin() + 1, boundary.end());
}

// The lower triangle, column by column, each starting with its diagonal.
Sparse LaplaceSolver::Implementation::assemble(const Connectivity& mesh) {
  const int size = static_cast<int>(vertices.size());
  std::vector<int> row(mesh.vertex_count(), -1);
  for (int i = 0; i < size; ++i) row[vertices[i]] = i;
  const auto for_entries = [&](auto visit) {
    for (int e = 0; e < mesh.edge_count(); ++e) {
      const int a = row[mesh.tail(mesh.halfedge(e))];
      const int b = row[mesh.tip(mesh.halfedge(e))];
      if (a >= 0 && b >= 0) visit(e, std::min(a, b), std::max(a, b));
    }
  };
  std::vector<int> start(size + 1, 1);
  start[0] = 0;
  for_entries([&](int, int column, int) { ++start[column + 1]; });
  std::partial_sum(start.begin(), start.end(), start.begin());
  auto matrix = owned<Sparse>(
      cholmod_allocate_sparse(size, size, start.back(), 0, 1, -1, CHOLMOD_REAL, workspace.get()),
      workspace);
  std::copy(start.begin(), start.end(), static_cast<int*>(matrix->p));
  int* const index = static_cast<int*>(matrix->i);
  double* const value = static_cast<double*>(matrix->x);
  for (int i = 0; i < size; ++i) {
    index[start[i]] = i;
    value[start[i]] = 0.0;
  }
  for (int e = 0; e < mesh.edge_count(); ++e) {
    for (const int v : {mesh.tail(mesh.halfedge(e)), mesh.tip(mesh.halfedge(e))}) {
      if (row[v] >= 0) value[start[row[v]]] += star1[e];
    }
  }
  std::vector<int> next = start;
  for_entries([&](int e, int column, int i) {
    const int place = ++next[column];
    index[place] = i;
    value[place] = -star1[e];
  });
  return matrix;
}

void LaplaceSolver::Implementation::factorise(const Sparse& matrix) {
  const auto size = matrix->nrow;
  std::vector<int> group(size, 0);
  std::fill(group.begin() + interior, group.end(), 1);
  std::vector<int> permutation(size);
  { cholmod_camd(matrix.get(), nullptr, 0, group.data(), permutation.data(), workspace.get()); }
  cholmod_common& common = *workspace.get();
  common.nmethods = 1;
  common.method[0].ordering = CHOLMOD_GIVEN;
  common.postorder = 0;  // keeps the groups apart
  {
    factor = owned<Factor>(cholmod_analyze_p(matrix.get(), permutation.data(), nullptr, 0, &common),
                           workspace);
  }
  { cholmod_factorize(matrix.get(), factor.get(), &common); }
  if (common.status != CHOLMOD_OK) {
    throw GeometryError(
        "the surface has triangles too thin to solve for harmonic functions on: remesh it");
  }
  nonzeros = static_cast<long>(common.lnz);
  const int* const rows = static_cast<const int*>(factor->Perm);
  for (std::size_t i = 0; i < size; ++i) order.push_back(vertices[rows[i]]);
}

// By the columns of L of which x has a part: few, if it has few nonzeros to begin with.
void LaplaceSolver::Implementation::forward_substitution(Eigen::Ref<Eigen::VectorXd> x) const {
  const int* const start = static_cast<const int*>(factor->p);
  const int* const count = static_cast<const int*>(factor->nz);
  const int* const row = static_cast<const int*>(factor->i);
  const double* const value = static_cast<const double*>(factor->x);
  for (Eigen::Index j = 0; j < x.size(); ++j) {
    if (x[j] == 0.0) continue;
    x[j] /= value[start[j]];
    for (int k = start[j] + 1; k < start[j] + count[j]; ++k) x[row[k]] -= value[k] * x[j];
  }
}

void LaplaceSolver::Implementation::solve_block(Eigen::Ref<Eigen::MatrixXd> x, Task task) const {
  const auto size = static_cast<Eigen::Index>(order.size());
  const Eigen::Index rows = task.dirichlet ? interior : size;
  Eigen::MatrixXd permuted = Eigen::MatrixXd::Zero(size, x.cols());
  for (Eigen::Index k = 0; k < x.cols(); ++k) {
    for (Eigen::Index i = 0; i < rows; ++i) permuted(i, k) = x(order[i], k);
  }
  Workspace own;
  if (task.is_sparse) {
    for (auto column : permuted.colwise()) forward_substitution(column);
  } else {
    cholmod_dense rhs = as_dense(permuted);
    const auto forward = owned<Dense>(cholmod_solve(CHOLMOD_L, factor.get(), &rhs, own.get()), own);
    std::copy_n(static_cast<const double*>(forward->x), permuted.size(), permuted.data());
  }
  // Without its last rows the intermediate vector is that of the leading block.
  permuted.bottomRows(size - rows).setZero();
  cholmod_dense rhs = as_dense(permuted);
  const auto solution = owned<Dense>(cholmod_solve(CHOLMOD_Lt, factor.get(), &rhs, own.get()), own);
  const Eigen::Map<const Eigen::MatrixXd> u(static_cast<const double*>(solution->x), size,
                                            x.cols());
  x.setZero();
  for (Eigen::Index k = 0; k < x.cols(); ++k) {
    for (Eigen::Index i = 0; i < rows; ++i) x(order[i], k) = u(i, k);
  }
}

void LaplaceSolver::Implementation::solve(Eigen::MatrixXd& x, Task task) const {
  if (order.empty() || (task.dirichlet && interior == 0)) {
    x.setZero();
    return;
  }
  const Eigen::Index blocks = (x.cols() + block_columns - 1) / block_columns;
  parallel_tasks(static_cast<std::size_t>(blocks), [&](std::size_t i) {
    const Eigen::Index first = static_cast<Eigen::Index>(i) * block_columns;
    solve_block(x.middleCols(first, std::min(block_columns, x.cols() - first)), task);
  });
}

LaplaceSolver::LaplaceSolver(const Connectivity& mesh, Eigen::VectorXd star1)
    : implementation_(std::make_unique<Implementation>()) {
  Implementation& s = *implementation_;
  s.star1 = std::move(star1);
  s.number_rows(mesh);
  if (s.vertices.empty()) return;
  s.factorise(s.assemble(mesh));
  for (int e = 0; e < mesh.edge_count(); ++e) {
    int a = mesh.tail(mesh.halfedge(e));
    int b = mesh.tip(mesh.halfedge(e));
    if (mesh.is_boundary_vertex(a) == mesh.is_boundary_vertex(b)) continue;
    if (mesh.is_boundary_vertex(a)) std::swap(a, b);
    s.coupling.push_back({a, b, s.star1[e]});
  }
}

LaplaceSolver::~LaplaceSolver() = default;
LaplaceSolver::LaplaceSolver(LaplaceSolver&&) noexcept = default;
LaplaceSolver& LaplaceSolver::operator=(LaplaceSolver&&) noexcept = default;

Eigen::MatrixXd LaplaceSolver::solve_dirichlet(const Eigen::MatrixXd& rhs) const {
  Eigen::MatrixXd u = rhs;
  implementation_->solve(u, {.dirichlet = true, .is_sparse = true});
  return u;
}

Eigen::MatrixXd LaplaceSolver::harmonic_extension(const Eigen::MatrixXd& boundary) const {
  const Implementation& s = *implementation_;
  Eigen::MatrixXd u = Eigen::MatrixXd::Zero(boundary.rows(), boundary.cols());
  for (const auto& c : s.coupling) u.row(c.interior) += c.weight * boundary.row(c.boundary);
  s.solve(u, {.dirichlet = true, .is_sparse = false});
  for (const int v : s.boundary) u.row(v) = boundary.row(v);
  return u;
}

Eigen::MatrixXd LaplaceSolver::solve_neumann(const Eigen::MatrixXd& rhs) const {
  Eigen::MatrixXd u = rhs;
  implementation_->solve(u, {.dirichlet = false, .is_sparse = false});
  return u;
}

long LaplaceSolver::factor_nonzeros() const {
  return implementation_->nonzeros;
}

const Eigen::VectorXd& LaplaceSolver::star1() const {
  return implementation_->star1;
}

}  // namespace hexwall
