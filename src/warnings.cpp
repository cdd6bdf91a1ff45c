#include "warnings.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace hexwall {
namespace {

// Chords of a circle of 16 quads miss 0.6 % of it: more than this is a missing piece of surface.
constexpr double noticeable_missing_area = 0.02;
// Rims off their planes by less, relative to their radii, look flat.
constexpr double noticeable_deviation = 0.01;
// The scaled Jacobian that hexes are held to where their quads allow it.
constexpr double poor_quad = 0.2;

void add_thickness_warning(PipelineResult& r, const ThicknessResult& side,
                           const std::string& what) {
  if (side.reduced_area_fraction == 0.0) return;
  const int v = side.worst_vertex;
  const Vec3& at = r.quads.points[v];
  r.warnings.push_back(
      fmt::format("the {} thinner than asked on {:.3g} % of the area, least at ({:.6g}, {:.6g}, "
                  "{:.6g}): {:.4g} instead of {:.4g}",
                  what, 100.0 * side.reduced_area_fraction, at.x(), at.y(), at.z(), side.given[v],
                  side.asked[v]));
}

}  // namespace

void add_warnings(PipelineResult& r) {
  for (const Opening& opening : r.openings) {
    if (opening.plane.deviation < noticeable_deviation * opening.plane.radius) continue;
    r.warnings.push_back(fmt::format(
        "{} at ({:.6g}, {:.6g}, {:.6g}) is not planar (off by {:.3g}): its end ring is not flat",
        opening.name, opening.plane.center.x(), opening.plane.center.y(), opening.plane.center.z(),
        opening.plane.deviation));
  }
  if (r.solution.refined.negative_edges > 0) {
    r.warnings.push_back(
        fmt::format("{} edges could not be made Delaunay: the triangles are very "
                    "distorted; remesh the surface",
                    r.solution.refined.negative_edges));
  }
  if (r.quad_quality.off_size_area_fraction > 0.1) {
    r.warnings.push_back(
        fmt::format("{:.0f} % of the area lies in quads more than 2x off the size asked for",
                    100.0 * r.quad_quality.off_size_area_fraction));
  }
  const double missing_area = 1.0 - r.quad_quality.area / total_area(r.surface);
  if (missing_area > noticeable_missing_area) {
    const auto corners = corners_of(r.quads, r.quad_quality.largest_quad);
    r.warnings.push_back(fmt::format(
        "the quads miss {:.1f} % of the surface's area: the tip of a blind region (an aneurysm's "
        "dome) is cut off; the largest quad, at ({:.6g}, {:.6g}, {:.6g}), is {:.3g} wide",
        100.0 * missing_area, corners[0].x(), corners[0].y(), corners[0].z(),
        std::sqrt(0.5 * doubled_area_vector(corners).norm())));
  }
  const std::vector<double>& jacobians = r.quad_quality.scaled_jacobian;
  const auto worst = std::min_element(jacobians.begin(), jacobians.end());
  if (*worst < poor_quad) {
    const Vec3 at = corners_of(r.quads, static_cast<int>(worst - jacobians.begin()))[0];
    r.warnings.push_back(fmt::format(
        "{} quads are badly shaped, with a scaled Jacobian below {}, the worst of {:.3g} at "
        "({:.6g}, {:.6g}, {:.6g}): they are too large for the surface there. Choose a smaller "
        "--size",
        std::count_if(jacobians.begin(), jacobians.end(), [](double j) { return j < poor_quad; }),
        poor_quad, *worst, at.x(), at.y(), at.z()));
  }
  if (r.columns_without_face_tets > 0) {
    r.warnings.push_back(fmt::format(
        "{} of {} quads are warped too much for layers as thin: checkMesh -allGeometry will report "
        "their face tets, which particle tracking needs. Fewer layers or a smaller --size avoid it",
        r.columns_without_face_tets, r.quads.quads.size()));
  }
  if (r.outward) add_thickness_warning(r, *r.outward, "wall is");
  if (r.inward) add_thickness_warning(r, *r.inward, "layers in the lumen are");
}

}  // namespace hexwall
