#include "pipeline.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "core/errors.h"
#include "dec/operators.h"
#include "holomorphic/energy.h"
#include "surface/check.h"
#include "surface/projector.h"

namespace hexwall {
namespace {

constexpr double default_quad_count = 20000.0;
constexpr double default_thickness_ratio = 0.1;
// Conformal sizes beyond this ratio to the target are met near zeros and in blind sacs, where the
// form's scale tends to 0: no quad should be asked to be that large or small.
constexpr double greatest_size_ratio = 3.0;

// Chords of a circle of 16 quads miss 0.6 % of it: more than this is a missing piece of surface.
constexpr double noticeable_missing_area = 0.02;

void require(bool holds, const std::string& message) {
  if (!holds) throw UsageError(message);
}

void check_options(const PipelineOptions& options) {
  const auto positive = [](double value) { return value > 0.0 && std::isfinite(value); };
  require(!options.size || positive(*options.size), "--size must be a positive length");
  require(!options.thickness || positive(*options.thickness),
          "--thickness must be a positive length");
  require(options.layers >= 1, "--layers must be at least 1");
  require(positive(options.growth), "--growth must be a positive ratio");
  require(options.relax >= 0.0 && options.relax <= 1.0, "--relax must lie between 0 and 1");
}

std::vector<Vec3> loop_points(const TriangleSurface& surface, const std::vector<int>& loop) {
  std::vector<Vec3> points;
  points.reserve(loop.size());
  for (const int v : loop) points.push_back(surface.points[v]);
  return points;
}

// Connectivity with the longest loop first, so that names do not depend on the file's order.
// Returns the former numbers of the loops.
std::vector<int> find_openings(PipelineResult& r) {
  r.connectivity = Connectivity(static_cast<int>(r.surface.points.size()), r.surface.triangles);
  const auto& loops = r.connectivity.loops();
  std::vector<double> lengths;
  lengths.reserve(loops.size());
  for (const auto& loop : loops) {
    lengths.push_back(LoopCurve(loop_points(r.surface, loop)).length());
  }
  std::vector<int> order(loops.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return lengths[a] > lengths[b]; });
  r.connectivity.reorder_loops(order);
  for (std::size_t i = 0; i < order.size(); ++i) {
    r.openings.push_back({fmt::format("loop_{}", i), lengths[order[i]],
                          fit_plane(loop_points(r.surface, r.connectivity.loops()[i]))});
  }
  return order;
}

// The refinement keeps loops and vertex numbers, so that its loops come in the same order.
void refine(PipelineResult& r, const std::vector<int>& loop_order) {
  r.refined = make_delaunay(r.surface);
  r.refined_connectivity =
      Connectivity(static_cast<int>(r.refined.surface.points.size()), r.refined.surface.triangles);
  r.refined_connectivity.reorder_loops(loop_order);
}

// |grad y| on each triangle of the refined surface.
std::vector<double> scale_factors(const PipelineResult& r) {
  const TriangleSurface& surface = r.refined.surface;
  std::vector<double> result;
  result.reserve(surface.triangles.size());
  for (int f = 0; f < static_cast<int>(surface.triangles.size()); ++f) {
    const auto& t = surface.triangles[f];
    Vec3 rotated = Vec3::Zero();
    for (int k = 0; k < 3; ++k) {
      rotated += r.form.y[t[k]] * (surface.points[t[(k + 2) % 3]] - surface.points[t[(k + 1) % 3]]);
    }
    result.push_back(rotated.norm() / doubled_area_vector(surface, f).norm());
  }
  return result;
}

void find_form(PipelineResult& r) {
  const Eigen::MatrixXd g = potentials(r.basis);
  const auto face_count = static_cast<int>(r.surface.triangles.size());
  const Eigen::VectorXd rho = Eigen::VectorXd::Ones(face_count);
  const auto energy = area_energy({r.refined.surface, r.refined.parent_face, face_count, g, rho});
  std::vector<double> lengths;
  for (const Opening& opening : r.openings) lengths.push_back(opening.length);
  r.optimum = optimal_form(*energy, lengths, r.basis.exterior);
  r.form = combine(r.refined_connectivity, r.basis, r.optimum.lambda);
  r.scale_factor = scale_factors(r);
}

// Area of the image of the surface under (x, y): the Dirichlet energy of y.
double conformal_area(const PipelineResult& r) {
  Eigen::VectorXd loop_values(r.basis.size());
  for (int i = 0; i < r.basis.size(); ++i) {
    loop_values[i] = r.form.y[r.refined_connectivity.loops()[r.basis.loop(i)].front()];
  }
  return loop_values.dot(r.basis.capacity * loop_values);
}

// Number of quads before rounding, if each cylinder is as dense around as along.
double expected_quads(const std::vector<Cylinder>& cylinders,
                      const std::vector<RowSpacing>& spacing) {
  double sum = 0.0;
  for (std::size_t c = 0; c < cylinders.size(); ++c) {
    if (cylinders[c].height() <= 0.0) continue;
    const double rows = spacing[c].wanted();
    sum += cylinders[c].circumference() * rows * rows / cylinders[c].height();
  }
  return sum;
}

// Integers such that quads of edge `size` would cover the area of the surface.
void find_numbers(PipelineResult& r) {
  const double area = total_area(r.surface);
  if (!r.options.size) r.options.size = std::sqrt(area / default_quad_count);
  const double size_in_plane = *r.options.size * std::sqrt(conformal_area(r) / area);
  r.spacing = space_rows(r.refined.surface, r.refined_connectivity, r.form, r.scale_factor,
                         r.foliation.cylinders, {*r.options.size, size_in_plane, r.options.relax});
  const double wanted = area / (*r.options.size * *r.options.size);
  const double factor = std::sqrt(wanted / expected_quads(r.foliation.cylinders, r.spacing));
  for (RowSpacing& spacing : r.spacing) {
    for (double& rows : spacing.rows) rows *= factor;
  }
  QuantiseOptions options;
  options.size = size_in_plane;
  r.numbers = quantise(r.foliation.cylinders, r.foliation.strips, r.spacing, options);
}

// Target size per quad: its conformal size, drawn towards the size asked for by `relax`.
std::vector<QuadSize> target_sizes(const PipelineResult& r) {
  const double size = *r.options.size;
  const auto target = [&](double conformal) {
    const double ratio =
        std::clamp(conformal / size, 1.0 / greatest_size_ratio, greatest_size_ratio);
    return size * std::pow(ratio, 1.0 - r.options.relax);
  };
  std::vector<QuadSize> targets;
  targets.reserve(r.conformal.mesh.quads.size());
  for (std::size_t q = 0; q < r.conformal.mesh.quads.size(); ++q) {
    double scale = 0.0;
    for (const int v : r.conformal.mesh.quads[q]) {
      scale += 0.25 * r.scale_factor[r.conformal.face[v]];
    }
    targets.push_back(
        {target(r.conformal.column_width[q] / scale), target(r.conformal.row_height[q] / scale)});
  }
  return targets;
}

std::vector<SurfacePoint> relax_quads(PipelineResult& r) {
  r.quads = r.conformal.mesh;
  std::vector<int> face;
  face.reserve(r.conformal.face.size());
  for (const int f : r.conformal.face) face.push_back(r.refined.parent_face[f]);
  r.relaxation = relax(r.quads, face, target_sizes(r), r.surface, r.connectivity);
  std::vector<SurfacePoint> places;
  places.reserve(face.size());
  for (std::size_t v = 0; v < face.size(); ++v) places.push_back({face[v], r.quads.points[v]});
  return places;
}

// Mean radius of the vessel: every ring of quads around it, taken as a circle, weighted by area.
double mean_radius(const PipelineResult& r) {
  double area_sum = 0.0;
  double sum = 0.0;
  for (std::size_t q = 0; q < r.quads.quads.size();) {
    const int around = r.numbers.around(r.foliation.strips, r.quads.cylinder[q]);
    double length = 0.0;
    double area = 0.0;
    for (int i = 0; i < around; ++i, ++q) {
      const auto p = corners_of(r.quads, static_cast<int>(q));
      length += 0.5 * ((p[1] - p[0]).norm() + (p[2] - p[3]).norm());
      area += 0.5 * doubled_area_vector(p).norm();
    }
    area_sum += area;
    sum += area * length / (2.0 * std::numbers::pi);
  }
  return sum / area_sum;
}

// Directions of extrusion: the surface's normals, kept in the planes of the loops, smoothed where
// the wall would not come out well.
std::vector<Vec3> find_directions(PipelineResult& r, const std::vector<SurfacePoint>& places) {
  std::vector<Vec3> directions = interpolated_normals(r.surface, places);
  std::vector<LoopPlane> planes;
  for (const Opening& opening : r.openings) planes.push_back(opening.plane);
  flatten_at_loops(r.quads, planes, directions);
  SmoothDirectionsOptions options;
  options.thickness = *r.options.thickness;
  options.layers = r.options.layers;
  options.growth = r.options.growth;
  r.smoothed_directions = smooth_directions(r.quads, planes, options, directions);
  return directions;
}

void extrude_wall(PipelineResult& r, std::vector<SurfacePoint> places) {
  if (!r.options.thickness) r.options.thickness = default_thickness_ratio * mean_radius(r);
  std::vector<Vec3> directions = find_directions(r, places);
  const SurfaceProjector projector(r.surface, r.connectivity);
  r.polishing = polish(r.quads, places, directions, projector,
                       {*r.options.thickness, r.options.layers, r.options.growth});
  r.quad_quality = quad_quality(r.quads, *r.options.size);
  std::vector<std::string> names;
  for (const Opening& opening : r.openings) names.push_back(opening.name);
  ExtrudeOptions options;
  options.thickness = *r.options.thickness;
  options.layers = r.options.layers;
  options.growth = r.options.growth;
  r.wall = extrude(r.quads, directions, names, options);
}

void collect_warnings(PipelineResult& r) {
  for (const Opening& opening : r.openings) {
    if (opening.plane.is_planar()) continue;
    r.warnings.push_back(fmt::format(
        "{} at ({:.6g}, {:.6g}, {:.6g}) is not planar (off by {:.3g}): its end ring is not flat",
        opening.name, opening.plane.center.x(), opening.plane.center.y(), opening.plane.center.z(),
        opening.plane.deviation));
  }
  if (r.refined.negative_edges > 0) {
    r.warnings.push_back(
        fmt::format("{} edges could not be made Delaunay: the triangles are very "
                    "distorted; remesh the surface",
                    r.refined.negative_edges));
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
  if (r.wall.reduced_area_fraction > 0.0) {
    const Vec3& at = r.quads.points[r.wall.worst_vertex];
    r.warnings.push_back(fmt::format(
        "the wall is thinner than asked on {:.3g} % of the area, least at ({:.6g}, {:.6g}, "
        "{:.6g}): {:.4g} instead of {:.4g}",
        100.0 * r.wall.reduced_area_fraction, at.x(), at.y(), at.z(), r.wall.thickness_min,
        *r.options.thickness));
  }
}

}  // namespace

PipelineResult run_pipeline(const TriangleSurface& surface, const PipelineOptions& options,
                            const ProgressCallback& progress) {
  check_options(options);
  PipelineResult r;
  r.options = options;
  StageClock clock(progress, 8);
  clock.begin("check");
  CheckResult check = check_surface(surface);
  r.surface = std::move(check.surface);
  r.warnings = std::move(check.notes);
  clock.begin("refine");
  refine(r, find_openings(r));
  clock.begin("forms");
  const Eigen::VectorXd star = star1(r.refined.surface, r.refined_connectivity);
  r.basis = holomorphic_basis(r.refined_connectivity, star);
  clock.begin("optimum");
  find_form(r);
  clock.begin("foliation");
  r.foliation = foliate(r.refined_connectivity, r.form);
  clock.begin("quads");
  find_numbers(r);
  r.conformal = extract_quads(r.refined.surface, r.refined_connectivity, r.form, r.foliation,
                              r.spacing, r.numbers);
  clock.begin("relax");
  std::vector<SurfacePoint> places = relax_quads(r);
  clock.begin("wall");
  extrude_wall(r, std::move(places));
  collect_warnings(r);
  clock.end();
  r.times = clock.times();
  return r;
}

}  // namespace hexwall
