#include "dec/laplace.h"

#include <gtest/gtest.h>

#include "dec/delaunay.h"
#include "dec/operators.h"
#include "support/expect_error.h"
#include "support/vessel_surfaces.h"

namespace hexwall {
namespace {

using test::connectivity_of;

struct PlanarMesh {
  TriangleSurface surface = make_delaunay(eccentric_annulus(1.0, 0.3, 0.4, 48, 9)).surface;
  Connectivity mesh = connectivity_of(surface);
  Eigen::VectorXd star = star1(surface, mesh);

  std::vector<bool> boundary() const {
    std::vector<bool> fixed(mesh.vertex_count());
    for (int v = 0; v < mesh.vertex_count(); ++v) fixed[v] = mesh.is_boundary_vertex(v);
    return fixed;
  }
};

TEST(LaplaceSolver, ReproducesLinearFunctions) {
  const PlanarMesh plane;
  const int count = plane.mesh.vertex_count();
  Eigen::MatrixXd exact(count, 2);
  for (int v = 0; v < count; ++v) {
    const Vec3& p = plane.surface.points[v];
    exact.row(v) << 2.0 + 3.0 * p.x() - p.y(), p.y();
  }
  // Rows of free vertices in `boundary` and of fixed ones in `rhs` have no say.
  Eigen::MatrixXd given = exact;
  Eigen::MatrixXd rhs = Eigen::MatrixXd::Zero(count, 2);
  for (int v = 0; v < count; ++v) {
    (plane.mesh.is_boundary_vertex(v) ? rhs : given).row(v).setConstant(1e6);
  }
  const LaplaceSolver solver(plane.mesh, plane.star, plane.boundary());
  EXPECT_LT((solver.solve(rhs, given) - exact).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(LaplaceSolver, SolvesForAnyRightHandSideAndBoundary) {
  const PlanarMesh plane;
  const int count = plane.mesh.vertex_count();
  std::srand(7);
  const Eigen::MatrixXd rhs = Eigen::MatrixXd::Random(count, 3);
  const Eigen::MatrixXd boundary = Eigen::MatrixXd::Random(count, 3);
  const LaplaceSolver solver(plane.mesh, plane.star, plane.boundary());
  const Eigen::MatrixXd u = solver.solve(rhs, boundary);
  const Eigen::SparseMatrix<double> derivative = d0(plane.mesh);
  const Eigen::MatrixXd laplacian_u =
      derivative.transpose() * (plane.star.asDiagonal() * (derivative * u));
  for (int v = 0; v < count; ++v) {
    if (plane.mesh.is_boundary_vertex(v)) {
      ASSERT_EQ(u.row(v), boundary.row(v));
    } else {
      ASSERT_LT((laplacian_u - rhs).row(v).norm(), 1e-11);
    }
  }
}

TEST(LaplaceSolver, SolvesTheNeumannProblemWithOneVertexFixed) {
  const PlanarMesh plane;
  const int count = plane.mesh.vertex_count();
  std::srand(8);
  Eigen::MatrixXd rhs = Eigen::MatrixXd::Random(count, 1);
  rhs.array() -= rhs.mean();  // solvable: then the equation holds at the fixed vertex as well
  std::vector<bool> fixed(count, false);
  fixed[5] = true;
  const LaplaceSolver solver(plane.mesh, plane.star, std::move(fixed));
  const Eigen::MatrixXd u = solver.solve(rhs, Eigen::MatrixXd::Zero(count, 1));
  EXPECT_EQ(u(5, 0), 0.0);
  const Eigen::SparseMatrix<double> derivative = d0(plane.mesh);
  const Eigen::MatrixXd residual =
      derivative.transpose() * (plane.star.asDiagonal() * (derivative * u)) - rhs;
  EXPECT_LT(residual.cwiseAbs().maxCoeff(), 1e-10);
}

TEST(LaplaceSolver, GivesTheBoundaryBackWhereNothingIsFree) {
  const PlanarMesh plane;
  const int count = plane.mesh.vertex_count();
  const LaplaceSolver solver(plane.mesh, plane.star, std::vector<bool>(count, true));
  const Eigen::MatrixXd boundary = Eigen::MatrixXd::Ones(count, 2);
  EXPECT_EQ(solver.solve(Eigen::MatrixXd::Zero(count, 2), boundary), boundary);
  EXPECT_EQ(solver.factor_nonzeros(), 0);
}

TEST(LaplaceSolver, RefusesWeightsThatAreNotPositive) {
  const PlanarMesh plane;
  test::expect_error(ExitCode::internal, {"not positive definite"},
                     [&] { LaplaceSolver(plane.mesh, -plane.star, plane.boundary()); });
}

}  // namespace
}  // namespace hexwall
