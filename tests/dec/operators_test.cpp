#include "dec/operators.h"

#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "dec/delaunay.h"
#include "dec/one_form.h"
#include "support/vessel_surfaces.h"

namespace hexwall {
namespace {

class Operators : public testing::TestWithParam<std::string> {
 protected:
  TriangleSurface surface_ = test::delaunay_of(*test::vessel_surface(GetParam())).surface;
  Connectivity mesh_ = connectivity_of(surface_);
};

INSTANTIATE_TEST_SUITE_P(Generated, Operators, testing::ValuesIn(test::coarse_shape_names()),
                         [](const auto& param) { return param.param; });

TEST_P(Operators, SecondDerivativeIsZeroExactly) {
  const Eigen::SparseMatrix<double> product = d1(mesh_) * d0(mesh_);
  ASSERT_EQ(product.rows(), mesh_.face_count());
  ASSERT_EQ(product.cols(), mesh_.vertex_count());
  for (int k = 0; k < product.outerSize(); ++k) {
    for (Eigen::SparseMatrix<double>::InnerIterator it(product, k); it; ++it) {
      ASSERT_EQ(it.value(), 0.0);
    }
  }
}

TEST_P(Operators, DerivativesDifferenceAlongHalfedges) {
  const Eigen::VectorXd u = Eigen::VectorXd::LinSpaced(mesh_.vertex_count(), -1.0, 2.0);
  const OneForm du{d0(mesh_) * u};
  for (int h = 0; h < mesh_.halfedge_count(); ++h) {
    ASSERT_EQ(du.along(mesh_, h), u[mesh_.tip(h)] - u[mesh_.tail(h)]);
    if (mesh_.twin(h) < 0) continue;
    ASSERT_EQ(du.along(mesh_, h), -du.along(mesh_, mesh_.twin(h)));
  }
  const OneForm any{Eigen::VectorXd::LinSpaced(mesh_.edge_count(), 0.0, 1.0)};
  const Eigen::VectorXd curl = d1(mesh_) * any.values;
  for (int f = 0; f < mesh_.face_count(); ++f) {
    const double sum =
        any.along(mesh_, 3 * f) + any.along(mesh_, 3 * f + 1) + any.along(mesh_, 3 * f + 2);
    ASSERT_NEAR(curl[f], sum, 1e-15);
  }
}

// Stiffness matrix of linear finite elements, without a cotangent: K_ij = e_i . e_j / (4 |T|), with
// e_i the edge opposite to corner i.
Eigen::SparseMatrix<double> stiffness(const TriangleSurface& surface) {
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t f = 0; f < surface.triangles.size(); ++f) {
    const auto& t = surface.triangles[f];
    const double quadruple_area = 2.0 * doubled_area_vector(surface, static_cast<int>(f)).norm();
    std::array<Vec3, 3> e;
    for (int i = 0; i < 3; ++i) {
      e[i] = surface.points[t[(i + 2) % 3]] - surface.points[t[(i + 1) % 3]];
    }
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) entries.emplace_back(t[i], t[j], e[i].dot(e[j]) / quadruple_area);
    }
  }
  const auto size = static_cast<Eigen::Index>(surface.points.size());
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

TEST_P(Operators, LaplacianIsTheFiniteElementStiffness) {
  const Eigen::SparseMatrix<double> derivative = d0(mesh_);
  const Eigen::VectorXd star = star1(surface_, mesh_);
  const Eigen::SparseMatrix<double> laplacian =
      derivative.transpose() * star.asDiagonal() * derivative;
  const Eigen::SparseMatrix<double> expected = stiffness(surface_);
  // Interior weights below zero by less than the tolerance of `make_delaunay` are raised to zero.
  EXPECT_LT((laplacian - expected).norm(), 1e-9 * expected.norm());
  const Eigen::VectorXd row_sums = laplacian * Eigen::VectorXd::Ones(mesh_.vertex_count());
  EXPECT_LT(row_sums.cwiseAbs().maxCoeff(), 1e-12);
}

TEST(HalfedgeCotangents, AreThoseOfTheOppositeAngles) {
  const TriangleSurface right{{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}, {{0, 1, 2}}};
  const Eigen::VectorXd of_right = halfedge_cotangents(right);
  EXPECT_NEAR(of_right[0], 1.0, 1e-15);
  EXPECT_NEAR(of_right[1], 0.0, 1e-15);
  EXPECT_NEAR(of_right[2], 1.0, 1e-15);
  // Angles 30 degrees at 0, 120 degrees at 1, 30 degrees at 2.
  const TriangleSurface obtuse{{{0, 0, 0}, {1, 0, 0}, {1.5, std::sqrt(0.75), 0}}, {{0, 1, 2}}};
  const Eigen::VectorXd of_obtuse = halfedge_cotangents(obtuse);
  EXPECT_NEAR(of_obtuse[0], std::sqrt(3.0), 1e-14);
  EXPECT_NEAR(of_obtuse[1], std::sqrt(3.0), 1e-14);
  EXPECT_NEAR(of_obtuse[2], -1.0 / std::sqrt(3.0), 1e-14);
}

TEST(Star1, HalvesTheSumAndRaisesNegativeOnesToZero) {
  // Two flat triangles on the x axis as their common edge: both angles opposite to it are obtuse.
  const TriangleSurface flat{{{-1, 0, 0}, {1, 0, 0}, {0, 0.5, 0}, {0, -0.5, 0}},
                             {{0, 1, 2}, {1, 0, 3}}};
  const Connectivity mesh = connectivity_of(flat);
  const Eigen::VectorXd star = star1(flat, mesh);
  for (int e = 0; e < mesh.edge_count(); ++e) {
    // cot(atan(1/2)) = 2 opposite to each outer edge.
    EXPECT_NEAR(star[e], mesh.is_boundary_edge(e) ? 1.0 : 0.0, 1e-14);
  }
}

}  // namespace
}  // namespace hexwall
