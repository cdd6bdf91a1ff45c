#include "surface/extend.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <fmt/format.h>

#include "core/errors.h"
#include "surface/connectivity.h"
#include "surface/loop_shape.h"
#include "surface/self_intersection.h"

namespace hexwall {
namespace {

using std::numbers::pi;
using Complex = std::complex<double>;

// The section is round, and the axis straight, after this part of the tube or this many radii.
constexpr double blended_part = 0.5;
constexpr double greatest_blend = 2.0;
// Cosine of the angle between axis and normal beyond which the end says nothing about the axis.
constexpr double least_axis_cosine = 0.5;

double smooth_step(double t) {
  return t * t * (3.0 - 2.0 * t);
}

std::string place(const LoopShape& shape) {
  return fmt::format("the opening at ({:.6g}, {:.6g}, {:.6g})", shape.center.x(), shape.center.y(),
                     shape.center.z());
}

/// Triangles around a loop down to `depth` below its plane.
std::vector<int> end_of_vessel(const TriangleSurface& surface, const Connectivity& mesh,
                               const std::vector<int>& loop, const LoopShape& shape, double depth) {
  std::vector<int> found;
  std::vector<char> seen(mesh.face_count(), 0);
  std::vector<int> open;
  const auto visit = [&](int f) {
    if (seen[f] != 0) return;
    seen[f] = 1;
    found.push_back(f);
    open.push_back(f);
  };
  for (const int v : loop) visit(Connectivity::face(mesh.outgoing(v)));
  while (!open.empty()) {
    const int f = open.back();
    open.pop_back();
    for (int k = 0; k < 3; ++k) {
      const int twin = mesh.twin(3 * f + k);
      if (twin < 0) continue;
      const Vec3 p = surface.points[mesh.apex(twin)] - shape.center;
      // The loop runs counter-clockwise around its normal, which points into the vessel.
      if (std::abs(p.dot(shape.normal)) <= depth && p.norm() <= 2.0 * depth + shape.radius) {
        visit(Connectivity::face(twin));
      }
    }
  }
  return found;
}

/// Direction of the vessel at its end, outward: that to which the wall's normals are most nearly
/// perpendicular. The loop's normal where that is no direction of a tube.
Vec3 axis_at_end(const TriangleSurface& surface, const std::vector<int>& faces,
                 const Vec3& outward) {
  Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();
  for (const int f : faces) {
    const Vec3 area = doubled_area_vector(surface, f);
    moment += area * area.transpose() / area.norm();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(moment);
  const Vec3 axis = solver.eigenvectors().col(0);
  const double cosine = axis.dot(outward);
  if (std::abs(cosine) < least_axis_cosine) return outward;
  return std::copysign(1.0, cosine) * axis;
}

/// The surface of one tube: points by height and by the fraction of the way around the loop.
class Tube {
 public:
  Tube(const std::vector<Vec3>& loop, const LoopShape& shape, const Vec3& axis, double radii)
      : center_(shape.center), outward_(-shape.normal) {
    e1_ = outward_.unitOrthogonal();
    e2_ = e1_.cross(outward_);
    add_points(loop, shape.length);
    const auto n = static_cast<double>(loop.size());
    radius_ = std::sqrt(2.0 * shape.area / (n * std::sin(2.0 * pi / n)));
    length_ = radii * radius_;
    blend_ = std::min(blended_part * length_, greatest_blend * radius_);
    const Vec3 tilt = axis / axis.dot(outward_) - outward_;
    tilt_ = {tilt.dot(e1_), tilt.dot(e2_)};
    find_turn();
  }

  double radius() const { return radius_; }
  double length() const { return length_; }
  const std::vector<double>& fractions() const { return fractions_; }

  /// The point at `height`, 0 at the loop and 1 at the end.
  Vec3 at(double height, double fraction) const {
    const auto [deviation, own_height] = on_loop(fraction);
    const double s = height * length_;
    const double round = smooth_step(std::min(s / blend_, 1.0));
    const Complex own = circle(fraction) + (1.0 - round) * deviation;
    const double bend = s < blend_ ? s - 0.5 * s * s / blend_ : 0.5 * blend_;
    const Complex p = own + bend * tilt_;
    const double z = (1.0 - height) * own_height + height * (highest_ + length_);
    return center_ + p.real() * e1_ + p.imag() * e2_ + z * outward_;
  }

 private:
  void add_points(const std::vector<Vec3>& loop, double loop_length) {
    double along = 0.0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vec3 p = loop[i] - center_;
      fractions_.push_back(along / loop_length);
      section_.emplace_back(p.dot(e1_), p.dot(e2_));
      heights_.push_back(p.dot(outward_));
      highest_ = std::max(highest_, heights_.back());
      along += (loop[(i + 1) % loop.size()] - loop[i]).norm();
    }
  }

  Complex circle(double fraction) const { return std::polar(radius_, turn_ + 2.0 * pi * fraction); }

  // How far the loop is from the circle and from its mean plane, linear between vertices.
  std::pair<Complex, double> on_loop(double fraction) const {
    fraction -= std::floor(fraction);
    const auto next = std::upper_bound(fractions_.begin(), fractions_.end(), fraction);
    const auto i = static_cast<std::size_t>(next - fractions_.begin()) - 1;
    const std::size_t j = (i + 1) % fractions_.size();
    const double end = j == 0 ? 1.0 : fractions_[j];
    const double t = (fraction - fractions_[i]) / (end - fractions_[i]);
    const Complex at_i = section_[i] - circle(fractions_[i]);
    const Complex at_j = section_[j] - circle(end);
    return {(1.0 - t) * at_i + t * at_j, (1.0 - t) * heights_[i] + t * heights_[j]};
  }

  // The turn of the circle that brings it nearest to the loop, in the sense of least squares.
  void find_turn() {
    Complex sum = 0.0;
    for (std::size_t i = 0; i < section_.size(); ++i) {
      const std::size_t j = (i + 1) % section_.size();
      sum += std::abs(section_[j] - section_[i]) *
             (section_[i] * std::polar(1.0, -2.0 * pi * fractions_[i]) +
              section_[j] * std::polar(1.0, -2.0 * pi * (j == 0 ? 1.0 : fractions_[j])));
    }
    turn_ = std::arg(sum);
  }

  Vec3 center_, outward_, e1_, e2_;
  std::vector<double> fractions_;  // of the loop's vertices
  std::vector<Complex> section_;
  std::vector<double> heights_;  // above the mean plane
  double highest_ = 0.0;
  double radius_ = 0.0;
  double length_ = 0.0;
  double blend_ = 0.0;
  double turn_ = 0.0;
  Complex tilt_;
};

/// A ring of vertices with their fractions of the way around, in rising order over one round.
struct Ring {
  std::vector<int> vertices;
  std::vector<double> fractions;

  int vertex(std::size_t i) const { return vertices[i % vertices.size()]; }
  double fraction(std::size_t i) const {
    const std::size_t round = i / fractions.size();
    return fractions[i % fractions.size()] + static_cast<double>(round);
  }
  double middle(std::size_t i) const { return 0.5 * (fraction(i) + fraction(i + 1)); }
};

/// Triangles between two rings, the upper one farther from the vessel: at each step the edge whose
/// middle comes first.
void stitch(const Ring& lower, const Ring& upper, TriangleSurface& surface) {
  const std::size_t n = lower.vertices.size();
  const std::size_t m = upper.vertices.size();
  for (std::size_t i = 0, j = 0; i < n || j < m;) {
    if (j == m || (i < n && lower.middle(i) <= upper.middle(j))) {
      surface.triangles.push_back({lower.vertex(i + 1), lower.vertex(i), upper.vertex(j)});
      ++i;
    } else {
      surface.triangles.push_back({lower.vertex(i), upper.vertex(j), upper.vertex(j + 1)});
      ++j;
    }
  }
}

/// Phase of the vertices on the loop if it were regular, in edges.
double phase_of(const std::vector<double>& fractions) {
  const auto n = static_cast<double>(fractions.size());
  Complex sum = 0.0;
  for (const double fraction : fractions) sum += std::polar(1.0, 2.0 * pi * n * fraction);
  const double phase = std::arg(sum) / (2.0 * pi);
  return phase < 0.0 ? phase + 1.0 : phase;
}

/// Adds the tube; returns the last ring.
Ring add_tube(const Tube& tube, const std::vector<int>& loop, double edge,
              TriangleSurface& surface) {
  const auto n = static_cast<double>(loop.size());
  const double row_height = 0.5 * std::sqrt(3.0) * edge;
  const int rows = std::max(1, static_cast<int>(std::lround(tube.length() / row_height)));
  const double phase = phase_of(tube.fractions());
  Ring lower{loop, tube.fractions()};
  for (int row = 1; row <= rows; ++row) {
    // Every second ring is turned by half an edge.
    double offset = phase + 0.5 * (row % 2);
    offset -= std::floor(offset);
    Ring upper;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      upper.fractions.push_back((static_cast<double>(i) + offset) / n);
      upper.vertices.push_back(static_cast<int>(surface.points.size()));
      surface.points.push_back(tube.at(static_cast<double>(row) / rows, upper.fractions.back()));
    }
    stitch(lower, upper, surface);
    lower = std::move(upper);
  }
  return lower;
}

void check_tubes(const ExtendResult& result, const std::vector<LoopShape>& shapes) {
  for (const auto& [f, g] : self_intersections(result.surface)) {
    const int tube = std::max(result.extension[f], result.extension[g]);
    if (tube < 0) continue;
    const int other = std::min(result.extension[f], result.extension[g]);
    const std::string met = other < 0       ? "the vessel"
                            : other == tube ? "itself"
                                            : "the extension of " + place(shapes[other]);
    throw GeometryError(
        fmt::format("the extension of {} runs into {}: ask for a shorter one with --extend",
                    place(shapes[tube]), met));
  }
}

}  // namespace

ExtendResult extend_openings(const TriangleSurface& surface, double radii) {
  if (!(radii > 0.0) || !std::isfinite(radii)) {
    throw UsageError("--extend must be a positive number of radii");
  }
  const Connectivity mesh = connectivity_of(surface);
  ExtendResult result{surface, std::vector<int>(surface.triangles.size(), -1), {}, {}};
  std::vector<LoopShape> shapes;
  for (std::size_t i = 0; i < mesh.loops().size(); ++i) {
    const std::vector<int>& loop = mesh.loops()[i];
    const std::vector<Vec3> points = points_of(surface, loop);
    const LoopShape shape = loop_shape(points);
    const auto end = end_of_vessel(surface, mesh, loop, shape, shape.radius);
    const Tube tube(points, shape, axis_at_end(surface, end, -shape.normal), radii);
    const double edge = shape.length / static_cast<double>(loop.size());
    result.end_vertex.push_back(add_tube(tube, loop, edge, result.surface).vertices.front());
    result.extension.resize(result.surface.triangles.size(), static_cast<int>(i));
    result.notes.push_back(fmt::format("extended {} by {:.4g}, to a circle of radius {:.4g}",
                                       place(shape), tube.length(), tube.radius()));
    shapes.push_back(shape);
  }
  check_tubes(result, shapes);
  return result;
}

}  // namespace hexwall
