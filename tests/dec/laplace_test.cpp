#include "dec/laplace.h"

#include <gtest/gtest.h>

#include "dec/delaunay.h"
#include "dec/operators.h"
#include "support/expect_error.h"
#include "support/vessel_surfaces.h"

namespace hexwall {
namespace {

struct PlanarMesh {
  TriangleSurface surface = test::delaunay_of(eccentric_annulus(1.0, 0.3, 0.4, 48, 9)).surface;
  Connectivity mesh = connectivity_of(surface);
  Eigen::VectorXd star = star1(surface, mesh);
};

Eigen::MatrixXd laplacian_of(const PlanarMesh& plane, const Eigen::MatrixXd& u) {
  const Eigen::SparseMatrix<double> derivative = d0(plane.mesh);
  return derivative.transpose() * (plane.star.asDiagonal() * (derivative * u));
}

Eigen::MatrixXd random_functions(const PlanarMesh& plane, int count, unsigned seed) {
  std::srand(seed);
  return Eigen::MatrixXd::Random(plane.mesh.vertex_count(), count);
}

TEST(LaplaceSolver, ReproducesLinearFunctions) {
  const PlanarMesh plane;
  const int count = plane.mesh.vertex_count();
  Eigen::MatrixXd exact(count, 2);
  for (int v = 0; v < count; ++v) {
    const Vec3& p = plane.surface.points[v];
    exact.row(v) << 2.0 + 3.0 * p.x() - p.y(), p.y();
  }
  Eigen::MatrixXd given = exact;  // its rows of interior vertices have no say
  for (int v = 0; v < count; ++v) {
    if (!plane.mesh.is_boundary_vertex(v)) given.row(v).setConstant(1e6);
  }
  const LaplaceSolver solver(plane.mesh, plane.star);
  EXPECT_LT((solver.harmonic_extension(given) - exact).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(LaplaceSolver, ExtendsAnyBoundaryHarmonically) {
  const PlanarMesh plane;
  const Eigen::MatrixXd boundary = random_functions(plane, 9, 7);  // more than one block
  const Eigen::MatrixXd u = LaplaceSolver(plane.mesh, plane.star).harmonic_extension(boundary);
  const Eigen::MatrixXd laplacian = laplacian_of(plane, u);
  for (int v = 0; v < plane.mesh.vertex_count(); ++v) {
    if (plane.mesh.is_boundary_vertex(v)) {
      ASSERT_EQ(u.row(v), boundary.row(v));
    } else {
      ASSERT_LT(laplacian.row(v).norm(), 1e-11);
    }
  }
}

TEST(LaplaceSolver, SolvesTheDirichletProblemForAnyRightHandSide) {
  const PlanarMesh plane;
  const Eigen::MatrixXd rhs = random_functions(plane, 3, 8);
  const Eigen::MatrixXd u = LaplaceSolver(plane.mesh, plane.star).solve_dirichlet(rhs);
  const Eigen::MatrixXd residual = laplacian_of(plane, u) - rhs;
  for (int v = 0; v < plane.mesh.vertex_count(); ++v) {
    if (plane.mesh.is_boundary_vertex(v)) {
      ASSERT_EQ(u.row(v).norm(), 0.0);
    } else {
      ASSERT_LT(residual.row(v).norm(), 1e-11);
    }
  }
}

TEST(LaplaceSolver, SolvesTheNeumannProblem) {
  const PlanarMesh plane;
  Eigen::MatrixXd rhs = random_functions(plane, 2, 9);
  // Solvable: then the equation holds at the vertex as well where the solution is given.
  rhs.rowwise() -= rhs.colwise().mean().eval();
  const Eigen::MatrixXd u = LaplaceSolver(plane.mesh, plane.star).solve_neumann(rhs);
  EXPECT_EQ(u.row(plane.mesh.loops()[0].front()).norm(), 0.0);
  EXPECT_LT((laplacian_of(plane, u) - rhs).cwiseAbs().maxCoeff(), 1e-10);
}

TEST(LaplaceSolver, GivesTheBoundaryBackWhereThereIsNoInterior) {
  const Connectivity mesh(3, {{0, 1, 2}});
  const Eigen::Vector3d boundary(1.0, 2.0, 3.0);
  const LaplaceSolver solver(mesh, Eigen::Vector3d::Ones());
  EXPECT_EQ(solver.harmonic_extension(boundary), boundary);
  EXPECT_EQ(solver.solve_dirichlet(boundary).norm(), 0.0);
}

TEST(LaplaceSolver, RefusesWeightsThatAreNotPositive) {
  const PlanarMesh plane;
  test::expect_error(ExitCode::geometry, {"too thin", "remesh"},
                     [&] { LaplaceSolver(plane.mesh, -plane.star); });
}

}  // namespace
}  // namespace hexwall
