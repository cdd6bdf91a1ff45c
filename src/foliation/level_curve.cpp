#include "foliation/level_curve.h"

#include <algorithm>

namespace hexwall {
namespace {

// Walks along a level set with the upper side on the left. Each crossed half-edge runs from a lower
// tail to an upper tip and belongs to the triangle that the walk leaves.
class Walker {
 public:
  Walker(const Connectivity& mesh, const HolomorphicForm& form, double level)
      : mesh_(mesh), form_(form), level_(level) {}

  EdgePoint crossing(int h) const {
    const double low = form_.y[mesh_.tail(h)];
    const double high = form_.y[mesh_.tip(h)];
    return {h, high > low ? std::clamp((level_ - low) / (high - low), 0.0, 1.0) : 0.5};
  }

  // The half-edge through which the walk leaves the triangle behind `from`.
  int next_crossing(const EdgePoint& from, bool apex_is_up) const {
    const int entry = mesh_.twin(from.halfedge);
    return apex_is_up ? Connectivity::next(entry) : Connectivity::prev(entry);
  }

  // Change of x from a crossing to the next one, which shares its lower or its upper vertex.
  double advance(const EdgePoint& from, const EdgePoint& to, bool apex_is_up) const {
    const double omega_from = form_.dx.along(mesh_, from.halfedge);
    const double omega_to = form_.dx.along(mesh_, to.halfedge);
    return apex_is_up ? to.t * omega_to - from.t * omega_from
                      : (1.0 - from.t) * omega_from - (1.0 - to.t) * omega_to;
  }

 private:
  const Connectivity& mesh_;
  const HolomorphicForm& form_;
  double level_;
};

void append(LevelCurve& curve, const EdgePoint& point, int face, double dx) {
  curve.points.push_back(point);
  curve.faces.push_back(face);
  curve.x.push_back(curve.x.back() + dx);
}

}  // namespace

bool make_monotone(std::vector<double>& x) {
  if (std::is_sorted(x.begin(), x.end())) return false;
  const double low = x.front();
  const double high = std::max(low, x.back());
  for (double& value : x) value = std::clamp(value, low, high);
  std::vector<double> lower(x);
  for (std::size_t i = x.size() - 1; i-- > 0;) lower[i] = std::min(lower[i], lower[i + 1]);
  double upper = low;
  for (std::size_t i = 0; i < x.size(); ++i) {
    upper = std::max(upper, x[i]);
    x[i] = 0.5 * (upper + lower[i]);
  }
  return true;
}

bool make_monotone_periodic(std::vector<double>& x) {
  if (std::is_sorted(x.begin(), x.end())) return false;
  // Three periods, of which the middle one has all that can reach it on both sides.
  const double period = x.back() - x.front();
  const std::size_t size = x.size() - 1;
  std::vector<double> lower;
  lower.reserve(3 * size);
  for (int k = -1; k <= 1; ++k) {
    for (std::size_t i = 0; i < size; ++i) lower.push_back(x[i] + k * period);
  }
  std::vector<double> upper(lower);
  for (std::size_t i = 1; i < upper.size(); ++i) upper[i] = std::max(upper[i], upper[i - 1]);
  for (std::size_t i = lower.size() - 1; i-- > 0;) lower[i] = std::min(lower[i], lower[i + 1]);
  for (std::size_t i = 0; i < size; ++i) x[i] = 0.5 * (upper[size + i] + lower[size + i]);
  x.back() = std::max(x.front() + period, x[size - 1]);  // rounding, where a plateau spans the seam
  return true;
}

LevelCurve trace_closed_level(const Connectivity& mesh, const HolomorphicForm& form, int start,
                              double level, double x_start) {
  const Walker walker(mesh, form, level);
  LevelCurve curve;
  curve.points.push_back(walker.crossing(start));
  curve.x.push_back(x_start);
  do {
    const EdgePoint from = curve.points.back();
    const int entry = mesh.twin(from.halfedge);
    const bool apex_is_up = form.y[mesh.apex(entry)] >= level;
    const EdgePoint to = walker.crossing(walker.next_crossing(from, apex_is_up));
    append(curve, to, Connectivity::face(entry), walker.advance(from, to, apex_is_up));
  } while (curve.points.back().halfedge != start);
  curve.corrected = make_monotone_periodic(curve.x);
  return curve;
}

TracedArc trace_arc(const Connectivity& mesh, const HolomorphicForm& form,
                    const std::vector<int>& ranks, int spoke) {
  const int origin = mesh.tail(spoke);
  const Walker walker(mesh, form, form.y[origin]);
  TracedArc arc;
  arc.curve.points.push_back({spoke, 0.0});
  arc.curve.x.push_back(0.0);
  const EdgePoint first = walker.crossing(Connectivity::next(spoke));
  append(arc.curve, first, Connectivity::face(spoke),
         form.dx.along(mesh, spoke) + first.t * form.dx.along(mesh, first.halfedge));
  for (;;) {
    const EdgePoint from = arc.curve.points.back();
    const int entry = mesh.twin(from.halfedge);
    const int rank = ranks[mesh.apex(entry)];
    if (rank == ranks[origin]) {
      const double omega = form.dx.along(mesh, from.halfedge);
      arc.arrival = Connectivity::prev(entry);
      append(arc.curve, {arc.arrival, 0.0}, Connectivity::face(entry),
             form.dx.along(mesh, Connectivity::next(entry)) - from.t * omega);
      break;
    }
    const bool apex_is_up = rank > ranks[origin];
    const EdgePoint to = walker.crossing(walker.next_crossing(from, apex_is_up));
    append(arc.curve, to, Connectivity::face(entry), walker.advance(from, to, apex_is_up));
  }
  return arc;
}

Vec3 position(const TriangleSurface& surface, const Connectivity& mesh, const EdgePoint& point) {
  return (1.0 - point.t) * surface.points[mesh.tail(point.halfedge)] +
         point.t * surface.points[mesh.tip(point.halfedge)];
}

SurfacePoint point_at(const TriangleSurface& surface, const Connectivity& mesh,
                      const LevelCurve& curve, double x) {
  const auto upper = std::upper_bound(curve.x.begin() + 1, curve.x.end() - 1, x);
  const std::size_t i = static_cast<std::size_t>(upper - curve.x.begin()) - 1;
  const double width = curve.x[i + 1] - curve.x[i];
  const double t = width > 0.0 ? std::clamp((x - curve.x[i]) / width, 0.0, 1.0) : 0.5;
  const Vec3 a = position(surface, mesh, curve.points[i]);
  const Vec3 b = position(surface, mesh, curve.points[i + 1]);
  return {curve.faces[i], (1.0 - t) * a + t * b};
}

}  // namespace hexwall
