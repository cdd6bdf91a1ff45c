#include "flow/cross_section.h"

#include <array>
#include <map>
#include <set>
#include <utility>

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseLU>

#include "core/errors.h"

namespace hexwall {
namespace {

using Complex = std::complex<double>;
using Matrix = Eigen::SparseMatrix<double>;

/// A triangle between a side of a face and the face's centre, all by unknown; -1 on the rim.
struct Element {
  std::array<int, 3> unknowns;
  std::array<Vec3, 3> corners;
  int face;
};

Vec3 area_vector(const Element& e) {
  return 0.5 * (e.corners[1] - e.corners[0]).cross(e.corners[2] - e.corners[0]);
}

using Side = std::pair<int, int>;

std::vector<Side> sides_of(const CellFace& face) {
  std::vector<Side> sides;
  const int n = face.size();
  for (int i = 0; i < n; ++i) sides.emplace_back(face.vertices[i], face.vertices[(i + 1) % n]);
  return sides;
}

/// Sides without a face on their other side.
std::vector<Side> rim_of(const std::vector<CellFace>& faces) {
  std::set<Side> all;
  for (const CellFace& face : faces)
    for (const Side& side : sides_of(face)) all.insert(side);
  std::vector<Side> rim;
  for (const auto& [a, b] : all)
    if (!all.contains({b, a})) rim.emplace_back(a, b);
  return rim;
}

/// Centre of area of a polygon, from the triangles around the mean of its corners.
Vec3 center_of_area(const std::vector<Vec3>& points, const CellFace& face) {
  Vec3 mean = Vec3::Zero();
  for (int i = 0; i < face.size(); ++i) mean += points[face.vertices[i]] / face.size();
  if (face.size() == 3) return mean;
  Vec3 sum = Vec3::Zero();
  double weight = 0.0;
  for (const auto& [a, b] : sides_of(face)) {
    const double area = (points[a] - mean).cross(points[b] - mean).norm();
    sum += area * (points[a] + points[b] + mean) / 3.0;
    weight += area;
  }
  return weight > 0.0 ? Vec3(sum / weight) : mean;
}

}  // namespace

struct CrossSection::Implementation {
  Vec3 normal;
  double area = 0.0;
  double perimeter = 0.0;
  std::vector<double> face_areas;
  std::vector<Vec3> face_centers;
  std::vector<Element> elements;
  int unknowns = 0;
  Matrix stiffness, mass;
  Eigen::VectorXd load;

  void measure(const std::vector<Vec3>& points, const std::vector<CellFace>& faces,
               const std::vector<Side>& rim);
  void number(const std::vector<Vec3>& points, const std::vector<CellFace>& faces,
              const std::vector<Side>& rim);
  void assemble();

  /// Means over the faces of a function given at the unknowns, scaled to the mean 1.
  template <typename T>
  std::vector<T> scaled_means(const Eigen::Matrix<T, Eigen::Dynamic, 1>& u) const {
    std::vector<T> means(face_areas.size(), T(0));
    std::vector<double> weight(face_areas.size(), 0.0);
    for (const Element& e : elements) {
      const double element_area = area_vector(e).norm();
      weight[e.face] += element_area;
      for (const int i : e.unknowns)
        if (i >= 0) means[e.face] += u[i] * (element_area / 3.0);
    }
    T flow(0);
    for (std::size_t f = 0; f < means.size(); ++f) {
      means[f] /= weight[f];
      flow += means[f] * face_areas[f];
    }
    for (T& mean : means) mean *= area / flow;
    return means;
  }
};

void CrossSection::Implementation::measure(const std::vector<Vec3>& points,
                                           const std::vector<CellFace>& faces,
                                           const std::vector<Side>& rim) {
  std::vector<Vec3> vectors(faces.size(), Vec3::Zero());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    face_centers.push_back(center_of_area(points, faces[f]));
    for (const auto& [a, b] : sides_of(faces[f]))
      vectors[f] += 0.5 * (points[a] - face_centers[f]).cross(points[b] - face_centers[f]);
  }
  Vec3 sum = Vec3::Zero();
  for (const Vec3& v : vectors) sum += v;
  normal = sum.normalized();
  for (const Vec3& v : vectors) {
    face_areas.push_back(normal.dot(v));
    area += face_areas.back();
    if (v.norm() > 0.0) continue;
    throw Error(ExitCode::internal, "a face of an opening has no area");
  }
  for (const auto& [a, b] : rim) perimeter += (points[b] - points[a]).norm();
}

void CrossSection::Implementation::number(const std::vector<Vec3>& points,
                                          const std::vector<CellFace>& faces,
                                          const std::vector<Side>& rim) {
  std::map<int, int> of_vertex;
  for (const auto& [a, b] : rim) of_vertex[a] = of_vertex[b] = -1;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const int center = unknowns++;
    for (const auto& [a, b] : sides_of(faces[f])) {
      for (const int v : {a, b})
        if (of_vertex.emplace(v, unknowns).second) ++unknowns;
      elements.push_back({{of_vertex[a], of_vertex[b], center},
                          {points[a], points[b], face_centers[f]},
                          static_cast<int>(f)});
    }
  }
}

void CrossSection::Implementation::assemble() {
  std::vector<Eigen::Triplet<double>> k;
  std::vector<Eigen::Triplet<double>> m;
  load = Eigen::VectorXd::Zero(unknowns);
  for (const Element& e : elements) {
    const double element_area = area_vector(e).norm();
    if (element_area == 0.0) continue;
    for (int i = 0; i < 3; ++i) {
      if (e.unknowns[i] < 0) continue;
      load[e.unknowns[i]] += element_area / 3.0;
      const Vec3 opposite_i = e.corners[(i + 2) % 3] - e.corners[(i + 1) % 3];
      for (int j = 0; j < 3; ++j) {
        if (e.unknowns[j] < 0) continue;
        const Vec3 opposite_j = e.corners[(j + 2) % 3] - e.corners[(j + 1) % 3];
        k.emplace_back(e.unknowns[i], e.unknowns[j],
                       opposite_i.dot(opposite_j) / (4.0 * element_area));
        m.emplace_back(e.unknowns[i], e.unknowns[j], element_area * (i == j ? 2.0 : 1.0) / 12.0);
      }
    }
  }
  for (Matrix* matrix : {&stiffness, &mass}) matrix->resize(unknowns, unknowns);
  stiffness.setFromTriplets(k.begin(), k.end());
  mass.setFromTriplets(m.begin(), m.end());
}

CrossSection::CrossSection(const std::vector<Vec3>& points, const std::vector<CellFace>& faces)
    : implementation_(std::make_unique<Implementation>()) {
  const std::vector<Side> rim = rim_of(faces);
  if (rim.empty()) throw Error(ExitCode::internal, "an opening without faces or without a rim");
  implementation_->measure(points, faces, rim);
  implementation_->number(points, faces, rim);
  implementation_->assemble();
}

CrossSection::~CrossSection() = default;
CrossSection::CrossSection(CrossSection&&) noexcept = default;
CrossSection& CrossSection::operator=(CrossSection&&) noexcept = default;

const Vec3& CrossSection::normal() const {
  return implementation_->normal;
}
double CrossSection::area() const {
  return implementation_->area;
}
double CrossSection::perimeter() const {
  return implementation_->perimeter;
}
const std::vector<double>& CrossSection::face_areas() const {
  return implementation_->face_areas;
}
const std::vector<Vec3>& CrossSection::face_centers() const {
  return implementation_->face_centers;
}

std::vector<double> CrossSection::steady() const {
  const Eigen::SimplicialLDLT<Matrix> solver(implementation_->stiffness);
  if (solver.info() != Eigen::Success)
    throw Error(ExitCode::internal, "the matrix of an inlet's profile is singular");
  const Eigen::VectorXd u = solver.solve(implementation_->load);
  return implementation_->scaled_means<double>(u);
}

std::vector<Complex> CrossSection::oscillating(double omega_over_nu) const {
  using ComplexMatrix = Eigen::SparseMatrix<Complex>;
  const ComplexMatrix matrix = implementation_->stiffness.cast<Complex>() +
                               Complex(0.0, omega_over_nu) * implementation_->mass.cast<Complex>();
  Eigen::SparseLU<ComplexMatrix> solver(matrix);
  if (solver.info() != Eigen::Success)
    throw Error(ExitCode::internal, "the matrix of an inlet's profile is singular");
  const Eigen::VectorXcd load = implementation_->load.cast<Complex>();
  const Eigen::VectorXcd u = solver.solve(load);
  return implementation_->scaled_means<Complex>(u);
}

}  // namespace hexwall
