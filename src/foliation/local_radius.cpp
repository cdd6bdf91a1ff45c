#include "foliation/local_radius.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/SparseCholesky>

#include "core/parallel.h"
#include "dec/operators.h"
#include "foliation/cylinder_faces.h"

namespace hexwall {
namespace {

constexpr int samples_per_cylinder = 64;
// Loops around a dome grow up to the widest one; a dip by less than this is noise of the surface.
constexpr double noticeable_dip = 0.03;

double length_of(const TriangleSurface& surface, const Connectivity& mesh,
                 const LevelCurve& curve) {
  double length = 0.0;
  for (std::size_t i = 0; i + 1 < curve.points.size(); ++i) {
    length +=
        (position(surface, mesh, curve.points[i + 1]) - position(surface, mesh, curve.points[i]))
            .norm();
  }
  return length;
}

// Radii of the level loops at evenly spaced heights of a cylinder.
std::vector<double> loop_radii(const TriangleSurface& surface, const Connectivity& mesh,
                               const HolomorphicForm& form, const Cylinder& cylinder) {
  std::vector<double> radii;
  for (int i = 0; i < samples_per_cylinder; ++i) {
    const double y = cylinder.y_bottom + cylinder.height() * (i + 0.5) / samples_per_cylinder;
    if (y <= cylinder.y_bottom || y >= cylinder.y_top) break;  // no height to speak of
    const LevelCurve curve = level_curve(mesh, form, cylinder, y);
    radii.push_back(length_of(surface, mesh, curve) / (2.0 * std::numbers::pi));
  }
  return radii;
}

// Gives the loops between a pole, before `first`, and the widest loop around its dome the radius of
// the latter.
template <typename Iterator>
void widen_dome(Iterator first, Iterator last) {
  Iterator widest = first;
  for (Iterator i = first; i != last && *i >= (1.0 - noticeable_dip) * *widest; ++i) {
    if (*i > *widest) widest = i;
  }
  if (first != last) std::fill(first, widest, *widest);
}

double at_height(const Cylinder& cylinder, const std::vector<double>& radii, double y) {
  const double place =
      (y - cylinder.y_bottom) / cylinder.height() * static_cast<double>(radii.size()) - 0.5;
  const double last = static_cast<double>(radii.size() - 1);
  const double clamped = std::clamp(place, 0.0, last);
  const auto i = std::min(static_cast<std::size_t>(clamped), radii.size() - 1);
  const std::size_t j = std::min(i + 1, radii.size() - 1);
  const double t = clamped - static_cast<double>(i);
  return (1.0 - t) * radii[i] + t * radii[j];
}

// Solves (M + t L) u = M r with the lumped mass matrix M: diffusion of r over a distance sqrt(t).
Eigen::VectorXd diffused(const TriangleSurface& surface, const Connectivity& mesh,
                         const Eigen::VectorXd& values, const Eigen::VectorXd& mass, double t) {
  const Eigen::VectorXd weights = star1(surface, mesh);
  std::vector<Eigen::Triplet<double>> entries;
  for (int v = 0; v < mesh.vertex_count(); ++v) entries.emplace_back(v, v, mass[v]);
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const int a = mesh.tail(mesh.halfedge(e));
    const int b = mesh.tip(mesh.halfedge(e));
    const double w = t * std::max(0.0, weights[e]);  // keeps the maximum principle
    entries.insert(entries.end(), {{a, a, w}, {b, b, w}, {a, b, -w}, {b, a, -w}});
  }
  Eigen::SparseMatrix<double> matrix(mesh.vertex_count(), mesh.vertex_count());
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(matrix);
  return solver.solve(mass.cwiseProduct(values));
}

}  // namespace

std::vector<double> local_radius(const TriangleSurface& surface, const Connectivity& mesh,
                                 const HolomorphicForm& form, const Foliation& foliation,
                                 int first_pole) {
  const auto is_pole = [&](int component) {
    return foliation.graph.components[component].loop >= first_pole;
  };
  const auto cylinder_count = static_cast<int>(foliation.cylinders.size());
  std::vector<std::vector<double>> radii(foliation.cylinders.size());
  parallel_tasks(radii.size(), [&](std::size_t c) {
    const Cylinder& cylinder = foliation.cylinders[c];
    radii[c] = loop_radii(surface, mesh, form, cylinder);
    if (is_pole(cylinder.bottom)) widen_dome(radii[c].begin(), radii[c].end());
    if (is_pole(cylinder.top)) widen_dome(radii[c].rbegin(), radii[c].rend());
  });
  // Area-weighted means over the triangles of each vertex, by the heights of their centroids.
  Eigen::VectorXd mass = Eigen::VectorXd::Constant(mesh.vertex_count(), 1e-300);
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(mesh.vertex_count());
  std::vector<int> last_visit(mesh.face_count(), -1);
  for (int c = 0; c < cylinder_count; ++c) {
    const Cylinder& cylinder = foliation.cylinders[c];
    if (radii[c].empty()) continue;
    visit_cylinder(mesh, form, foliation, c, last_visit, [&](int f, const auto&) {
      const auto& t = mesh.triangles()[f];
      const double y = (form.y[t[0]] + form.y[t[1]] + form.y[t[2]]) / 3.0;
      if (y < cylinder.y_bottom || y > cylinder.y_top) return;
      const double third = doubled_area_vector(surface, f).norm() / 6.0;
      for (const int v : t) {
        mass[v] += third;
        sum[v] += third * at_height(cylinder, radii[c], y);
      }
    });
  }
  const double mean = sum.sum() / mass.sum();
  const Eigen::VectorXd raw = sum.cwiseQuotient(mass);
  const Eigen::VectorXd smooth = diffused(surface, mesh, raw, mass, mean * mean);
  return {smooth.begin(), smooth.end()};
}

}  // namespace hexwall
