#include "surface/vessel_field.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace hexwall {
namespace {

constexpr int samples_per_span = 16;  // bends of 60 degrees per span become steps of 4 degrees
constexpr double extension = 1.5;     // of an open end, in radii: its round tip is then cut away
constexpr int newton_steps = 12;      // 4 reach rounding from an edge away, more beside a crease

template <typename T>
T catmull_rom(const std::vector<T>& p, std::size_t span, double t) {
  const T& b = p[span];
  const T& c = p[span + 1];
  // Reflected neighbours at the ends make the curve leave along its first and last chord.
  const T a = span == 0 ? T(2.0 * b - c) : p[span - 1];
  const T d = span + 2 == p.size() ? T(2.0 * c - b) : p[span + 2];
  return b + 0.5 * t *
                 ((c - a) + t * ((2.0 * a - 5.0 * b + 4.0 * c - d) + t * (3.0 * (b - c) + d - a)));
}

/// Quadratic smooth minimum: equal to min(a, b) where they differ by more than `width`.
VesselField::Sample smooth_min(const VesselField::Sample& a, const VesselField::Sample& b,
                               double width) {
  const auto& [low, high] = a.value <= b.value ? std::tie(a, b) : std::tie(b, a);
  const double overlap = width - (high.value - low.value);
  if (overlap <= 0.0) return low;
  const double weight = overlap / (2.0 * width);
  return {low.value - 0.5 * overlap * weight,
          (1.0 - weight) * low.gradient + weight * high.gradient};
}

}  // namespace

// Signed distance to the hull of two balls: in the half-plane of the axis and x, the foot on the
// axis slides by the slope of the hull's side (I. Quilez, "Round cone").
VesselField::Sample VesselField::RoundCone::distance(const Vec3& x) const {
  const Vec3 axis = b - a;
  const double length2 = axis.squaredNorm();
  const double slope = radius_a - radius_b;
  const double along = (x - a).dot(axis) / length2;
  const double across = ((x - a) - along * axis).norm();
  const double lean2 = length2 - slope * slope;
  const double foot =
      lean2 > 0.0 ? along - across * slope / std::sqrt(lean2 * length2) : (slope > 0.0 ? 0.0 : 1.0);
  const double t = std::clamp(foot, 0.0, 1.0);
  const Vec3 arm = x - a - t * axis;
  const double length = arm.norm();
  return {length - (radius_a - t * slope), arm / std::max(length, 1e-300)};
}

VesselField::VesselField(const std::vector<Branch>& branches)
    : smallest_radius_(std::numeric_limits<double>::max()) {
  for (const Branch& branch : branches) {
    tubes_.push_back(tube_of(branch));
    bounds_.extend(tubes_.back().bounds);
    for (const double r : branch.radii) smallest_radius_ = std::min(smallest_radius_, r);
  }
}

void VesselField::add_cone(Tube& tube, const RoundCone& cone) {
  tube.cones.push_back(cone);
  const Vec3 one = Vec3::Ones();
  tube.bounds.extend(Vec3(cone.a - cone.radius_a * one)).extend(Vec3(cone.a + cone.radius_a * one));
  tube.bounds.extend(Vec3(cone.b - cone.radius_b * one)).extend(Vec3(cone.b + cone.radius_b * one));
}

void VesselField::extend(Tube& tube, const OpenEnd& end) {
  const Vec3 tip = end.center + extension * end.radius * end.direction;
  add_cone(tube, {end.center, tip, end.radius, end.radius});
  ends_.push_back(end);
}

VesselField::Tube VesselField::tube_of(const Branch& branch) {
  Tube tube{{}, {}, branch.blend};
  const std::vector<Vec3>& p = branch.centerline;
  const std::vector<double>& r = branch.radii;
  for (std::size_t span = 0; span + 1 < p.size(); ++span) {
    for (int i = 0; i < samples_per_span; ++i) {
      const double s = static_cast<double>(i) / samples_per_span;
      const double t = static_cast<double>(i + 1) / samples_per_span;
      add_cone(tube, {catmull_rom(p, span, s), catmull_rom(p, span, t), catmull_rom(r, span, s),
                      catmull_rom(r, span, t)});
    }
  }
  if (branch.open_start) extend(tube, {p.front(), (p[0] - p[1]).normalized(), r.front()});
  const std::size_t last = p.size() - 1;
  if (branch.open_end) extend(tube, {p.back(), (p[last] - p[last - 1]).normalized(), r.back()});
  return tube;
}

VesselField::Sample VesselField::tube_distance(const Tube& tube, const Vec3& x) {
  Sample nearest{std::numeric_limits<double>::max(), Vec3::Zero()};
  for (const RoundCone& cone : tube.cones) {
    const Sample sample = cone.distance(x);
    if (sample.value < nearest.value) nearest = sample;
  }
  return nearest;
}

VesselField::Sample VesselField::operator()(const Vec3& x) const {
  Sample sample = tube_distance(tubes_.front(), x);
  for (std::size_t i = 1; i < tubes_.size(); ++i) {
    // A tube is at least as far away as its box, and without effect beyond its blend.
    const double lower_bound = tubes_[i].bounds.exteriorDistance(x);
    if (lower_bound > 0.0 && lower_bound >= sample.value + tubes_[i].blend) continue;
    sample = smooth_min(sample, tube_distance(tubes_[i], x), tubes_[i].blend);
  }
  return sample;
}

Vec3 VesselField::project(const Vec3& x, double tolerance) const {
  Vec3 y = x;
  for (int i = 0; i < newton_steps; ++i) {
    const auto [value, gradient] = (*this)(y);
    if (std::abs(value) <= tolerance) break;
    y -= value / gradient.squaredNorm() * gradient;
  }
  return y;
}

Vec3 VesselField::project_in_plane(const Vec3& x, const OpenEnd& end) const {
  const auto flatten = [&end](const Vec3& v) -> Vec3 {
    return v - v.dot(end.direction) * end.direction;
  };
  Vec3 y = end.center + flatten(x - end.center);
  for (int i = 0; i < newton_steps; ++i) {
    const auto [value, gradient] = (*this)(y);
    const Vec3 g = flatten(gradient);
    y -= value / g.squaredNorm() * g;
  }
  return end.center + flatten(y - end.center);
}

}  // namespace hexwall
