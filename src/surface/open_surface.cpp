#include "surface/open_surface.h"

#include <cmath>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "core/errors.h"
#include "surface/clip.h"
#include "surface/loop_shape.h"
#include "surface/open_caps.h"
#include "surface/regions.h"

namespace hexwall {
namespace {

// A cut that takes more than this part of the surface is likely to have its normal the wrong way.
constexpr double suspicious_part = 0.5;

OpenedCap opened(const TriangleSurface& surface, const std::vector<int>& loop, const Vec3& outward,
                 std::string name, std::string how) {
  const LoopShape shape = loop_shape(points_of(surface, loop));
  const Vec3 normal = shape.normal.dot(outward) < 0.0 ? Vec3(-shape.normal) : shape.normal;
  return {std::move(name), shape.center, shape.radius, normal, shape.area, std::move(how)};
}

void follow_origin(std::vector<int>& origin, const std::vector<int>& step) {
  std::vector<int> followed;
  followed.reserve(step.size());
  for (const int f : step) followed.push_back(origin[f]);
  origin = std::move(followed);
}

void cut_off(OpenResult& result, const CutPlane& plane) {
  ClipResult clipped = clip(result.surface, plane);
  result.caps.push_back(opened(clipped.surface, clipped.loop, plane.normal, plane.name, "cut"));
  result.notes.push_back(describe(result.caps.back()));
  const double part = 1.0 - total_area(clipped.surface) / total_area(result.surface);
  if (part > suspicious_part) {
    result.notes.push_back(fmt::format(
        "the cut at ({:.6g}, {:.6g}, {:.6g}) removed {:.0f} % of the surface; if that is the wrong "
        "side, turn its normal around",
        plane.point.x(), plane.point.y(), plane.point.z(), 100.0 * part));
  }
  follow_origin(result.origin, clipped.origin);
  result.surface = std::move(clipped.surface);
}

std::vector<Cap> find_caps(const TriangleSurface& surface,
                           const std::vector<SurfaceArray>& cell_arrays,
                           const OpenOptions& options) {
  if (!options.cap_array && !options.automatic) return {};
  std::vector<Cap> caps = labelled_caps(surface, cell_arrays, options.cap_array);
  return caps.empty() ? flat_caps(surface) : caps;
}

void remove_caps(OpenResult& result, const std::vector<Cap>& caps) {
  if (caps.empty()) return;
  std::vector<char> is_removed(result.surface.triangles.size(), 0);
  for (const Cap& cap : caps) {
    for (const int f : cap.triangles) is_removed[f] = 1;
    result.caps.push_back(opened(result.surface, cap.rim, cap.outward, cap.name, cap.how));
    result.notes.push_back(describe(result.caps.back()));
  }
  std::vector<int> kept;
  for (int f = 0; f < static_cast<int>(is_removed.size()); ++f) {
    if (is_removed[f] == 0) kept.push_back(f);
  }
  if (kept.empty()) throw GeometryError("all of the surface is marked as caps: nothing is left");
  result.surface = part_of(result.surface, kept).surface;
  follow_origin(result.origin, kept);
}

}  // namespace

std::string describe(const OpenedCap& cap) {
  // Rounding errors of the normal and -0 are of no interest.
  const auto rounded = [](double x) { return 0.0 + std::round(1e3 * x) / 1e3; };
  return fmt::format("opened {} ({}): centre {}, radius {:.4g}, normal ({}, {}, {}), area {:.4g}",
                     cap.name.empty() ? "an end" : cap.name, cap.how, coordinates(cap.center),
                     cap.radius, rounded(cap.normal.x()), rounded(cap.normal.y()),
                     rounded(cap.normal.z()), cap.area);
}

OpenResult open_surface(const TriangleSurface& surface,
                        const std::vector<SurfaceArray>& cell_arrays, const OpenOptions& options) {
  OpenResult result;
  result.surface = surface;
  result.origin.resize(surface.triangles.size());
  std::iota(result.origin.begin(), result.origin.end(), 0);
  for (const CutPlane& plane : options.cuts) cut_off(result, plane);
  const auto arrays = follow(cell_arrays, result.origin);
  remove_caps(result, find_caps(result.surface, arrays, options));
  return result;
}

}  // namespace hexwall
