#include "bench/bare_cholmod.h"

#include <array>
#include <cholmod.h>
#include <vector>

#include <Eigen/SparseCore>

namespace hexwall::bench {
namespace {

using Matrix = Eigen::SparseMatrix<double>;

// The lower triangle of the Laplacian without the rows and columns of some vertices.
Matrix laplacian(const Connectivity& mesh, const Eigen::VectorXd& star1,
                 const std::vector<char>& fixed) {
  std::vector<int> row(mesh.vertex_count(), -1);
  int size = 0;
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    if (fixed[v] == 0) row[v] = size++;
  }
  std::vector<Eigen::Triplet<double>> entries;
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const int a = row[mesh.tail(mesh.halfedge(e))];
    const int b = row[mesh.tip(mesh.halfedge(e))];
    if (a >= 0) entries.emplace_back(a, a, star1[e]);
    if (b >= 0) entries.emplace_back(b, b, star1[e]);
    if (a >= 0 && b >= 0) entries.emplace_back(std::max(a, b), std::min(a, b), -star1[e]);
  }
  Matrix matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

cholmod_sparse view(Matrix& matrix) {
  cholmod_sparse s{};
  s.nrow = s.ncol = static_cast<std::size_t>(matrix.rows());
  s.nzmax = static_cast<std::size_t>(matrix.nonZeros());
  s.p = matrix.outerIndexPtr();
  s.i = matrix.innerIndexPtr();
  s.x = matrix.valuePtr();
  s.stype = -1;
  s.itype = CHOLMOD_INT;
  s.xtype = CHOLMOD_REAL;
  s.dtype = CHOLMOD_DOUBLE;
  s.sorted = 1;
  s.packed = 1;
  return s;
}

}  // namespace

struct BareCholmod::Implementation {
  std::array<Matrix, 2> matrices;
  cholmod_common common{};
};

BareCholmod::BareCholmod(const Connectivity& mesh, const Eigen::VectorXd& star1)
    : implementation_(std::make_unique<Implementation>()) {
  std::vector<char> fixed(mesh.vertex_count());
  for (int v = 0; v < mesh.vertex_count(); ++v) fixed[v] = mesh.is_boundary_vertex(v) ? 1 : 0;
  implementation_->matrices[0] = laplacian(mesh, star1, fixed);
  fixed.assign(fixed.size(), 0);
  fixed[mesh.loops()[0].front()] = 1;
  implementation_->matrices[1] = laplacian(mesh, star1, fixed);
  cholmod_start(&implementation_->common);
  implementation_->common.supernodal = CHOLMOD_SIMPLICIAL;  // the faster one at these sizes
}

BareCholmod::~BareCholmod() {
  cholmod_finish(&implementation_->common);
}

double BareCholmod::run(int n) {
  double nonzeros = 0.0;
  cholmod_common* const common = &implementation_->common;
  for (Matrix& m : implementation_->matrices) {
    cholmod_sparse matrix = view(m);
    cholmod_factor* factor = cholmod_analyze(&matrix, common);
    cholmod_factorize(&matrix, factor, common);
    nonzeros += common->lnz;
    cholmod_dense* rhs =
        cholmod_ones(matrix.nrow, static_cast<std::size_t>(n), CHOLMOD_REAL, common);
    cholmod_dense* solution = cholmod_solve(CHOLMOD_A, factor, rhs, common);
    cholmod_free_dense(&solution, common);
    cholmod_free_dense(&rhs, common);
    cholmod_free_factor(&factor, common);
  }
  return nonzeros;
}

}  // namespace hexwall::bench
