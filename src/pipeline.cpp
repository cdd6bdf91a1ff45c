#include "pipeline.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "core/errors.h"
#include "core/parallel.h"
#include "foliation/local_radius.h"
#include "surface/counted.h"
#include "surface/loop_shape.h"
#include "surface/projector.h"
#include "wall.h"
#include "warnings.h"

namespace hexwall {
namespace {

constexpr double default_quad_count = 20000.0;
// The default size is smaller where an opening would have fewer quads around than this, which fold,
// but never so small that there would be more in all.
constexpr double least_quads_around = 9.0;
constexpr double most_default_quads = 4.0 * default_quad_count;
// Conformal sizes beyond this ratio to the target are met near zeros and in blind sacs, where the
// form's scale tends to 0: no quad should be asked to be that large or small.
constexpr double greatest_size_ratio = 3.0;

// Radii within this factor of the mean give target edges; beyond, a branch would take most quads.
constexpr double greatest_edge_ratio = 8.0;

double square(double x) {
  return x * x;
}

void require(bool holds, const std::string& message) {
  if (!holds) throw UsageError(message);
}

void check_options(const PipelineOptions& options) {
  const auto positive = [](double value) { return value > 0.0 && std::isfinite(value); };
  require(!options.size || positive(*options.size), "--size must be a positive length");
  require(options.poles.count >= 0, "--poles must not be negative");
  check_layer_options(options);
  require(options.stretch >= 0.1 && options.stretch <= 10.0,
          "--stretch must lie between 0.1 and 10");
  require(options.relax >= 0.0 && options.relax <= 1.0, "--relax must lie between 0 and 1");
}

// Brings the loops in the order of the openings, each at the loop of the nearest centre that is
// left: the longest of those with one centre, since openings are numbered so.
void find_openings(const PrepareResult& input, PipelineResult& r) {
  r.connectivity = connectivity_of(r.surface);
  const auto& loops = r.connectivity.loops();
  std::vector<LoopPlane> planes;
  std::vector<double> lengths;
  for (const auto& loop : loops) {
    planes.push_back(fit_plane(points_of(r.surface, loop)));
    lengths.push_back(loop_shape(points_of(r.surface, loop)).length);
  }
  std::vector<int> left(loops.size());
  std::iota(left.begin(), left.end(), 0);
  std::stable_sort(left.begin(), left.end(), [&](int a, int b) { return lengths[a] > lengths[b]; });
  std::vector<int> order;
  for (const NamedPlace& opening : input.openings) {
    const auto nearest = std::min_element(left.begin(), left.end(), [&](int a, int b) {
      return (planes[a].center - opening.at).squaredNorm() <
             (planes[b].center - opening.at).squaredNorm();
    });
    const int loop = *nearest;
    left.erase(nearest);
    order.push_back(loop);
    r.openings.push_back({opening.name, lengths[loop], planes[loop]});
  }
  r.connectivity.reorder_loops(order);
}

std::vector<double> face_means(const TriangleSurface& surface, const std::vector<double>& values) {
  std::vector<double> means;
  means.reserve(surface.triangles.size());
  for (const auto& [a, b, c] : surface.triangles) {
    means.push_back((values[a] + values[b] + values[c]) / 3.0);
  }
  return means;
}

// Radius of the vessel at each vertex over its mean over the surface, from the form of even sizes.
std::vector<double> relative_radii(const PipelineResult& r) {
  const Eigen::VectorXd even = Eigen::VectorXd::Ones(r.connectivity.face_count());
  const FormSolution s = solve_form({r.surface, r.connectivity, even});
  std::vector<double> radii = local_radius(s.refined.surface, s.connectivity, s.form,
                                           foliate(s.connectivity, s.form), s.first_pole());
  radii.resize(r.surface.points.size());  // the refinement's own vertices come after the input's
  const std::vector<double> of_faces = face_means(r.surface, radii);
  double sum = 0.0;
  for (std::size_t f = 0; f < of_faces.size(); ++f) {
    sum += of_faces[f] * 0.5 * doubled_area_vector(r.surface, static_cast<int>(f)).norm();
  }
  const double mean = sum / total_area(r.surface);
  for (double& radius : radii) {
    radius = std::clamp(radius / mean, 1.0 / greatest_edge_ratio, greatest_edge_ratio);
  }
  return radii;
}

void find_relative_edges(PipelineResult& r) {
  const std::size_t count = r.surface.points.size();
  r.relative_edge = r.options.size_field;
  if (r.relative_edge.empty()) r.relative_edge.assign(count, 1.0);
  require(r.relative_edge.size() == count, "the size field needs one value for each vertex");
  for (std::size_t v = 0; v < count; ++v) {
    if (r.relative_edge[v] > 0.0 && std::isfinite(r.relative_edge[v])) continue;
    const Vec3& at = r.surface.points[v];
    throw UsageError(
        fmt::format("the size field is {} at ({:.6g}, {:.6g}, {:.6g}): target edge "
                    "lengths must be positive",
                    r.relative_edge[v], at.x(), at.y(), at.z()));
  }
  if (!r.options.size_by_radius) return;
  const std::vector<double> radii = relative_radii(r);
  for (std::size_t v = 0; v < count; ++v) r.relative_edge[v] *= radii[v];
}

void find_form(PipelineResult& r) {
  const std::vector<double> of_faces = face_means(r.surface, r.relative_edge);
  const Eigen::VectorXd edge = Eigen::Map<const Eigen::VectorXd>(
      of_faces.data(), static_cast<Eigen::Index>(of_faces.size()));
  const FormProblem problem{r.surface, r.connectivity, edge};
  PoleResult found{solve_form(problem), {}};
  const PoleRequest& poles = r.options.poles;
  if (poles.mode == PoleRequest::Mode::automatic) {
    PoleOptions options;
    options.most = poles.most;
    found = place_poles(problem, std::move(found.solution), options);
  } else if (poles.mode == PoleRequest::Mode::count) {
    PoleOptions options;
    options.most = poles.count;
    options.only_if_worthwhile = false;
    found = place_poles(problem, std::move(found.solution), options);
    if (static_cast<int>(found.poles.size()) < poles.count) {
      r.warnings.push_back(
          fmt::format("{} asked for, {} placed: more would vanish, or there is no room for them",
                      counted(poles.count, "pole"), found.poles.size()));
    }
  } else if (poles.mode == PoleRequest::Mode::places) {
    found = place_poles_at(problem, std::move(found.solution), poles.places);
  }
  r.solution = std::move(found.solution);
  r.solution.laplace.reset();
  r.poles = std::move(found.poles);
}

// Area of the image of the surface under (x, y): the Dirichlet energy of y.
double conformal_area(const FormSolution& s) {
  Eigen::VectorXd loop_values(s.basis.size());
  for (int i = 0; i < s.basis.size(); ++i) {
    loop_values[i] = s.form.y[s.connectivity.loops()[s.basis.loop(i)].front()];
  }
  return loop_values.dot(s.basis.capacity * loop_values);
}

// Integral of 1 / edge^2 over the triangles: the number of quads if `size` were 1.
double wanted_quads(const TriangleSurface& surface, const std::vector<int>& parent_face,
                    const std::vector<double>& edge) {
  double sum = 0.0;
  for (std::size_t f = 0; f < parent_face.size(); ++f) {
    const double area = 0.5 * doubled_area_vector(surface, static_cast<int>(f)).norm();
    sum += area / (edge[parent_face[f]] * edge[parent_face[f]]);
  }
  return sum;
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

double default_size(const PipelineResult& r, double wanted) {
  double size = std::sqrt(wanted / default_quad_count);
  for (std::size_t i = 0; i < r.openings.size(); ++i) {
    const std::vector<int>& loop = r.connectivity.loops()[i];
    double edge = 0.0;
    for (const int v : loop) edge += r.relative_edge[v] / static_cast<double>(loop.size());
    size = std::min(size, r.openings[i].length / (edge * least_quads_around));
  }
  return std::max(size, std::sqrt(wanted / most_default_quads));
}

// Integers such that quads of the target sizes would cover the area of the surface.
void find_numbers(PipelineResult& r) {
  const FormSolution& s = r.solution;
  const std::vector<double> edge = face_means(r.surface, r.relative_edge);
  std::vector<int> faces(edge.size());
  std::iota(faces.begin(), faces.end(), 0);
  if (!r.options.size) r.options.size = default_size(r, wanted_quads(r.surface, faces, edge));
  const double wanted =
      wanted_quads(s.refined.surface, s.refined.parent_face, edge) / square(*r.options.size);
  const double size_in_plane = std::sqrt(conformal_area(s) / wanted);
  r.spacing = space_rows(s.refined.surface, s.connectivity, s.form, {s.scale_factor, s.size_ratio},
                         r.foliation.cylinders, {size_in_plane, r.options.relax});
  const double factor = std::sqrt(wanted / expected_quads(r.foliation.cylinders, r.spacing));
  for (RowSpacing& spacing : r.spacing) {
    for (double& rows : spacing.rows) rows *= factor;
  }
  QuantiseOptions options;
  options.size = size_in_plane;
  options.stretch = r.options.stretch;
  for (std::size_t i = 0; i < r.poles.size(); ++i) {
    options.poles.push_back(s.first_pole() + static_cast<int>(i));
  }
  r.numbers = quantise(r.foliation, r.spacing, options);
}

// The conformal quads with their poles closed. \returns the places of all vertices.
std::vector<SurfacePoint> close_poles(PipelineResult& r, const SurfaceProjector& projector) {
  const FormSolution& s = r.solution;
  r.quads = r.conformal.mesh;
  std::vector<SurfacePoint> places;
  for (std::size_t v = 0; v < r.conformal.face.size(); ++v) {
    places.push_back({s.refined.parent_face[r.conformal.face[v]], r.quads.points[v]});
  }
  std::vector<double> spacing;
  for (std::size_t q = 0; q < r.conformal.row_height.size(); ++q) {
    spacing.push_back(r.conformal.row_height[q] / r.conformal.column_width[q]);
  }
  for (std::size_t i = 0; i < s.disks.size(); ++i) {
    const PoleSite site{s.first_pole() + static_cast<int>(i), s.disks[i].center, s.disk_faces[i]};
    r.pole_caps.push_back(close_pole(r.quads, places, site, spacing, projector));
  }
  return places;
}

// Target size per quad: its conformal size, drawn towards the size asked for by `relax`.
std::vector<QuadSize> target_sizes(const PipelineResult& r) {
  std::vector<QuadSize> targets;
  targets.reserve(r.quads.quads.size());
  for (std::size_t q = 0; q < r.quads.quads.size(); ++q) {
    double wanted = 0.0;
    for (const int v : r.quads.quads[q]) wanted += 0.25 * r.target_edge[v];
    const auto target = [&](double conformal, double stretch) {
      const double length = stretch * wanted;
      const double ratio =
          std::clamp(conformal / length, 1.0 / greatest_size_ratio, greatest_size_ratio);
      return length * std::pow(ratio, 1.0 - r.options.relax);
    };
    if (q >= r.conformal.mesh.quads.size()) {
      const auto after =
          std::find_if(r.pole_caps.rbegin(), r.pole_caps.rend(),
                       [&](const PoleCap& c) { return c.first_quad <= static_cast<int>(q); });
      const double edge = target(after->mean_edge, 1.0);
      targets.push_back({edge, edge});
      continue;
    }
    double scale = 0.0;
    for (const int v : r.conformal.mesh.quads[q]) {
      scale += 0.25 * r.solution.scale_factor[r.conformal.face[v]];
    }
    targets.push_back({target(r.conformal.column_width[q] / scale, 1.0),
                       target(r.conformal.row_height[q] / scale, r.options.stretch)});
  }
  return targets;
}

std::vector<SurfacePoint> relax_quads(PipelineResult& r, const SurfaceProjector& projector) {
  std::vector<SurfacePoint> places = close_poles(r, projector);
  r.target_edge = target_edges(r, places);
  std::vector<int> face;
  face.reserve(places.size());
  for (const SurfacePoint& place : places) face.push_back(place.face);
  r.relaxation = relax(r.quads, face, target_sizes(r), r.surface, r.connectivity);
  for (std::size_t v = 0; v < face.size(); ++v) places[v] = {face[v], r.quads.points[v]};
  return places;
}

// A quad belongs to an extension if most of its corners do.
void find_extensions(const std::vector<int>& of_face, const std::vector<SurfacePoint>& places,
                     PipelineResult& r) {
  r.extension.reserve(r.quads.quads.size());
  for (const auto& quad : r.quads.quads) {
    std::array<int, 4> corners;
    for (int k = 0; k < 4; ++k) corners[k] = of_face[places[quad[k]].face];
    std::sort(corners.begin(), corners.end());
    r.extension.push_back(corners[1] == corners[2] ? corners[1] : -1);
  }
}

void run_stages(const PrepareResult& input, const PipelineOptions& options,
                const ProgressCallback& progress, PipelineResult& r) {
  r.options = options;
  StageClock clock(progress, 5);
  r.surface = input.surface;
  r.warnings = input.warnings;
  find_openings(input, r);
  clock.begin("form");
  find_relative_edges(r);
  find_form(r);
  clock.begin("foliation");
  r.foliation = foliate(r.solution.connectivity, r.solution.form);
  clock.begin("quads");
  find_numbers(r);
  r.conformal = extract_quads(r.solution.refined.surface, r.solution.connectivity, r.solution.form,
                              r.foliation, r.spacing, r.numbers);
  clock.begin("relax");
  const SurfaceProjector projector(r.surface, r.connectivity);
  std::vector<SurfacePoint> places;
  std::vector<double> radius;
  parallel_tasks(2, [&](std::size_t task) {
    if (task == 0) {
      places = relax_quads(r, projector);
    } else {
      const FormSolution& s = r.solution;
      radius = local_radius(s.refined.surface, s.connectivity, s.form, r.foliation, s.first_pole());
    }
  });
  clock.begin("wall");
  make_wall(r, places, projector, radius);
  find_extensions(input.extension, places, r);
  add_warnings(r);
  clock.end();
  r.times = clock.times();
}

}  // namespace

std::string loop_name(const PipelineResult& result, int loop) {
  const int first_pole = result.solution.first_pole();
  return loop < first_pole ? result.openings[loop].name
                           : fmt::format("pole_{}", loop - first_pole + 1);
}

PipelineResult run_pipeline(const PrepareResult& input, const PipelineOptions& options,
                            const ProgressCallback& progress) {
  check_options(options);
  PipelineOptions tried = options;
  for (;;) {
    PipelineResult r;
    try {
      run_stages(input, tried, progress, r);
    } catch (const MeshingError& error) {
      if (r.poles.empty() || options.thickness_strict) throw;
      if (tried.poles.mode != PoleRequest::Mode::automatic) {
        throw MeshingError(std::string(error.what()) + "; or fewer or other --poles");
      }
      tried.poles.most = static_cast<int>(r.poles.size()) - 1;
      continue;
    }
    if (tried.poles.most < options.poles.most) {
      r.warnings.push_back(
          fmt::format("with more than {} no valid mesh was found: blind regions have large quads",
                      counted(r.poles.size(), "pole")));
    }
    return r;
  }
}

PipelineResult run_pipeline(const TriangleSurface& surface, const PipelineOptions& options,
                            const ProgressCallback& progress) {
  return run_pipeline(use_as_it_is(surface), options, progress);
}

}  // namespace hexwall
