#include "dec/operators.h"

#include <algorithm>
#include <vector>

#include <Eigen/Geometry>

namespace hexwall {

Eigen::VectorXd halfedge_cotangents(const TriangleSurface& surface) {
  const int face_count = static_cast<int>(surface.triangles.size());
  Eigen::VectorXd cotangents(3 * face_count);
  for (int f = 0; f < face_count; ++f) {
    const double doubled_area = doubled_area_vector(surface, f).norm();
    for (int k = 0; k < 3; ++k) {
      const Vec3& apex = surface.points[surface.triangles[f][(k + 2) % 3]];
      const Vec3 u = surface.points[surface.triangles[f][k]] - apex;
      const Vec3 v = surface.points[surface.triangles[f][(k + 1) % 3]] - apex;
      cotangents[3 * f + k] = u.dot(v) / doubled_area;
    }
  }
  return cotangents;
}

Eigen::VectorXd star1(const TriangleSurface& surface, const Connectivity& mesh) {
  const Eigen::VectorXd cotangents = halfedge_cotangents(surface);
  Eigen::VectorXd star = Eigen::VectorXd::Zero(mesh.edge_count());
  for (int h = 0; h < mesh.halfedge_count(); ++h) star[mesh.edge(h)] += 0.5 * cotangents[h];
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (!mesh.is_boundary_edge(e)) star[e] = std::max(star[e], 0.0);
  }
  return star;
}

Eigen::SparseMatrix<double> d0(const Connectivity& mesh) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(2 * mesh.edge_count());
  for (int e = 0; e < mesh.edge_count(); ++e) {
    entries.emplace_back(e, mesh.tail(mesh.halfedge(e)), -1.0);
    entries.emplace_back(e, mesh.tip(mesh.halfedge(e)), 1.0);
  }
  Eigen::SparseMatrix<double> matrix(mesh.edge_count(), mesh.vertex_count());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

Eigen::SparseMatrix<double> d1(const Connectivity& mesh) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(mesh.halfedge_count());
  for (int h = 0; h < mesh.halfedge_count(); ++h) {
    entries.emplace_back(Connectivity::face(h), mesh.edge(h), mesh.sign(h));
  }
  Eigen::SparseMatrix<double> matrix(mesh.face_count(), mesh.edge_count());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace hexwall
