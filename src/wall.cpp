#include "wall.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "core/errors.h"
#include "hex/directions.h"
#include "hex/even_out.h"
#include "hex/mend_face_tets.h"
#include "hex/quality.h"

namespace hexwall {
namespace {

constexpr double default_outward_ratio = 0.1;
constexpr double default_inward_ratio = 0.15;
// Where the wall became thinner, faces between its layers may be warped too much for OpenFOAM. So
// many times columns are evened out and fitted again, those faces weighing the more the later, if
// it is no more than this share of the columns.
constexpr int most_fits = 8;
constexpr double rounds_to_full_weight = 3.0;
constexpr double most_lacking = 0.02;
// So much must the least scaled Jacobian gain for each share of the area where the wall gets
// thinner.
constexpr double jacobian_per_area = 20.0;
// The worst columns are raised so often, as long as one is worse than this.
constexpr int most_raises = 4;
constexpr double good_scaled_jacobian = 0.58;
// Evening out leaves this share of the shortest edge at a vertex, however often.
constexpr double least_share_of_edge = 0.5;

void require(bool holds, const std::string& message) {
  if (!holds) throw UsageError(message);
}

void check_side(const LayerOptions& o) {
  const auto is_length = [](const std::optional<double>& value) {
    return !value || (*value > 0.0 && std::isfinite(*value));
  };
  require(is_length(o.thickness), "--thickness must be a positive length");
  require(is_length(o.thickness_ratio), "--thickness-ratio must be a positive ratio");
  require(is_length(o.thickness_min) && is_length(o.thickness_max),
          "--thickness-min and --thickness-max must be positive lengths");
  require(!o.thickness_min || !o.thickness_max || *o.thickness_min <= *o.thickness_max,
          "--thickness-min must not be above --thickness-max");
  require(o.layers >= 1, "--layers must be at least 1");
  require(o.growth > 0.0 && std::isfinite(o.growth), "--growth must be a positive ratio");
}

// Mean radius of the vessel: every ring of quads around it, taken as a circle, weighted by area.
double mean_radius(const PipelineResult& r) {
  double area_sum = 0.0;
  double sum = 0.0;
  for (std::size_t q = 0; q < r.conformal.mesh.quads.size();) {
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

// Mean of values at the vertices of a loop.
double loop_mean(const std::vector<double>& values, const std::vector<int>& loop) {
  double sum = 0.0;
  for (const int v : loop) sum += values[v];
  return sum / static_cast<double>(loop.size());
}

// Local radius at the quads' vertices, taken where they lay before relaxation; the vertices that
// close a pole have that of its loop.
std::vector<double> radii_of_vertices(const PipelineResult& r,
                                      const std::vector<double>& of_surface) {
  const FormSolution& s = r.solution;
  std::vector<SurfacePoint> places;
  for (std::size_t v = 0; v < r.conformal.face.size(); ++v) {
    places.push_back({r.conformal.face[v], r.conformal.mesh.points[v]});
  }
  std::vector<double> radii = interpolated_values(s.refined.surface, of_surface, places);
  radii.resize(r.quads.points.size());
  for (const PoleCap& cap : r.pole_caps) {
    const double radius = loop_mean(of_surface, s.connectivity.loops()[cap.loop]);
    const int last = cap.first_quad + cap.around * cap.around / 16;
    for (int q = cap.first_quad; q < last; ++q) {
      for (const int v : r.quads.quads[q]) {
        if (v >= static_cast<int>(places.size())) radii[v] = radius;
      }
    }
  }
  return radii;
}

std::vector<double> asked_thickness(const PipelineResult& r, const LayerOptions& o,
                                    const std::vector<SurfacePoint>& places) {
  std::vector<double> thickness(places.size(), o.thickness.value_or(0.0));
  if (!o.thickness_field.empty()) {
    thickness = interpolated_values(r.surface, o.thickness_field, places);
  } else if (o.thickness_ratio) {
    thickness = r.radius;
    for (double& t : thickness) t *= *o.thickness_ratio;
  }
  for (std::size_t v = 0; v < thickness.size(); ++v) {
    double& t = thickness[v];
    if (o.thickness_min) t = std::max(t, *o.thickness_min);
    if (o.thickness_max) t = std::min(t, *o.thickness_max);
    if (t > 0.0 && std::isfinite(t)) continue;
    const Vec3& at = places[v].position;
    throw UsageError(fmt::format(
        "the thickness asked for is {:.6g} at ({:.6g}, {:.6g}, {:.6g}): it must be positive; "
        "--thickness-min gives a lower bound",
        t, at.x(), at.y(), at.z()));
  }
  return thickness;
}

void check_field(const PipelineResult& r, const std::optional<LayerOptions>& o) {
  require(!o || o->thickness_field.empty() || o->thickness_field.size() == r.surface.points.size(),
          "the thickness needs one value for each vertex");
}

void fill_in_defaults(PipelineResult& r) {
  const auto has_default = [](const std::optional<LayerOptions>& o) {
    return o && !o->thickness && !o->thickness_ratio && o->thickness_field.empty();
  };
  if (has_default(r.options.outward)) {
    r.options.outward->thickness = default_outward_ratio * mean_radius(r);
  }
  if (has_default(r.options.inward)) r.options.inward->thickness_ratio = default_inward_ratio;
}

std::vector<LayerGroup> groups_of(const std::optional<LayerOptions>& o, const std::string& prefix) {
  if (!o) return {};
  return o->groups.empty() ? graded_layers(o->layers, o->growth, prefix) : o->groups;
}

WallShape shape_of(const PipelineResult& r, const std::vector<SurfacePoint>& places) {
  WallShape shape{r.layers, {}, {}};
  if (r.options.outward) shape.outward = asked_thickness(r, *r.options.outward, places);
  if (r.options.inward) shape.inward = asked_thickness(r, *r.options.inward, places);
  return shape;
}

// Directions of extrusion: the surface's normals, kept in the planes of the loops, smoothed where
// the wall would not come out well.
std::vector<Vec3> find_directions(PipelineResult& r, const std::vector<SurfacePoint>& places,
                                  const WallShape& shape) {
  std::vector<Vec3> directions = interpolated_normals(r.surface, places);
  std::vector<LoopPlane> planes;
  for (const Opening& opening : r.openings) planes.push_back(opening.plane);
  flatten_at_loops(r.quads, planes, directions);
  r.smoothed_directions = smooth_directions(r.quads, planes, shape, directions);
  return directions;
}

/// Quads and directions, and the thickness that fits them.
struct WallFit {
  QuadMesh quads;
  std::vector<SurfacePoint> places;
  std::vector<Vec3> directions;
  WallShape shape;
  std::optional<ThicknessResult> outward, inward;
  int columns_without_face_tets = 0;
  int evened_vertices = 0;
  double min_scaled_jacobian = 0.0;
  std::vector<double> least_edge;  // #V to which evening out may shorten edges

  double reduced_area_fraction() const {
    return (outward ? outward->reduced_area_fraction : 0.0) +
           (inward ? inward->reduced_area_fraction : 0.0);
  }
};

WallFit not_fitted(const QuadMesh& quads, const std::vector<SurfacePoint>& places,
                   const std::vector<Vec3>& directions) {
  WallFit fit;
  fit.quads = quads;
  fit.places = places;
  fit.directions = directions;
  return fit;
}

// Hexes good enough come first, then faces that OpenFOAM can split.
bool is_better(const WallFit& a, const WallFit& b) {
  const auto merit = [](const WallFit& fit) {
    return std::pair(std::min(wanted_scaled_jacobian, fit.min_scaled_jacobian),
                     -fit.columns_without_face_tets);
  };
  return merit(a) > merit(b);
}

/// Finds the thickest wall up to what is asked, of columns evened out.
class WallFitter {
 public:
  WallFitter(const PipelineResult& r, const SurfaceProjector& projector, ColumnQualities& columns)
      : r_(r), projector_(projector), columns_(columns) {
    const bool for_core = r.options.leaves_room_for_core;
    if (r.options.outward) outward_.emplace(r.quads, r.layers, Side::outward, for_core);
    if (r.options.inward) inward_.emplace(r.quads, r.layers, Side::inward, for_core);
  }

  /// \param start not fitted.
  /// \throws MeshingError if no wall fits.
  WallFit run(WallFit start) {
    start.shape = shape_of(r_, start.places);
    start.least_edge = shortest_edges(start.quads);
    for (double& edge : start.least_edge) edge *= least_share_of_edge;
    return raise_worst(win_face_tets(first_fit(std::move(start))));
  }

 private:
  std::span<const ColumnQuality> columns_of(const WallFit& fit) {
    return columns_.of(fit.quads, fit.directions, fit.shape);
  }

  // Thickness that fits on each side, up to the share of what is asked that an earlier fit gave.
  void fit_sides(WallFit& fit) {
    fit.shape = shape_of(r_, fit.places);
    if (outward_) fit_side(fit, *outward_, fit.shape.outward, fit.outward);
    if (inward_) fit_side(fit, *inward_, fit.shape.inward, fit.inward);
    const std::span<const ColumnQuality> columns = columns_of(fit);
    fit.columns_without_face_tets =
        static_cast<int>(std::count_if(columns.begin(), columns.end(), [](const ColumnQuality& c) {
          return c.face_tet_margin <= 0.0;
        }));
    fit.min_scaled_jacobian = least_scaled_jacobian(columns);
  }

  static void fit_side(const WallFit& fit, ThicknessFitter& fitter, std::vector<double>& thickness,
                       std::optional<ThicknessResult>& result) {
    std::vector<double> shares;
    int colliding_quads = 0;
    if (result) {
      for (int v = 0; v < static_cast<int>(result->given.size()); ++v) {
        shares.push_back(result->ratio(v));
      }
      colliding_quads = result->colliding_quads;
    }
    result = fitter.fit(fit.quads, fit.directions, fit.shape, shares);
    result->colliding_quads = std::max(result->colliding_quads, colliding_quads);
    thickness = result->given;
  }

  // The same, or nothing where no thickness fits.
  std::optional<WallFit> fitted(WallFit fit) {
    try {
      fit_sides(fit);
      return fit;
    } catch (const MeshingError&) {
      return std::nullopt;
    }
  }

  // Evens out poor columns and fits the thickness, or returns nothing: where the quads are far too
  // large for the surface, evening out may fold them. `face_tets` as for `even_out`.
  std::optional<WallFit> evened_out(WallFit fit, double face_tets) {
    const EvenOutOptions options{columns_of(fit), fit.least_edge, face_tets};
    fit.evened_vertices +=
        even_out(fit.quads, fit.places, fit.directions, projector_, fit.shape, options);
    fit.outward.reset();  // more may fit now
    fit.inward.reset();
    return fitted(std::move(fit));
  }

  // Evened out once, unless that makes it worse.
  WallFit first_fit(WallFit start) {
    const std::optional<WallFit> fit = evened_out(start, 0.0);
    if (fit && fit->min_scaled_jacobian >= wanted_scaled_jacobian) return *fit;
    if (!fit) {
      fit_sides(start);
      return start;
    }
    const std::optional<WallFit> as_it_was = fitted(std::move(start));
    return as_it_was && is_better(*as_it_was, *fit) ? *as_it_was : *fit;
  }

  // Evened out again while faces of a few columns cannot be split.
  WallFit win_face_tets(WallFit fit) {
    const double most = most_lacking * static_cast<double>(fit.quads.quads.size());
    WallFit best = fit;
    for (int round = 1; round <= most_fits; ++round) {
      if (fit.columns_without_face_tets == 0 || fit.columns_without_face_tets > most) break;
      std::optional<WallFit> next = evened_out(std::move(fit), round / rounds_to_full_weight);
      if (!next) break;
      fit = std::move(*next);
      // Of equals the later, where more weighed on margins.
      if (!is_better(best, fit)) best = fit;
    }
    if (best.columns_without_face_tets == 0 || best.columns_without_face_tets > most) return best;
    WallFit mended = best;
    mended.evened_vertices +=
        mend_face_tets(mended.quads, mended.places, mended.directions, projector_, mended.shape);
    const std::optional<WallFit> refitted = fitted(std::move(mended));
    return refitted && is_better(*refitted, best) ? *refitted : best;
  }

  // Raises the worst columns further, again while some are poor.
  WallFit raise_worst(WallFit fit) {
    for (int round = 0; round < most_raises; ++round) {
      std::optional<WallFit> raised = raised_worst(fit);
      if (!raised) break;
      fit = std::move(*raised);
      if (fit.min_scaled_jacobian >= good_scaled_jacobian) break;
    }
    return fit;
  }

  // Nothing if that costs faces that can be split, or more thickness than it is worth.
  std::optional<WallFit> raised_worst(const WallFit& fit) {
    WallFit trial = fit;
    const EvenOutOptions options{columns_of(fit), fit.least_edge};
    trial.evened_vertices += even_out_worst(trial.quads, trial.places, trial.directions, projector_,
                                            trial.shape, options);
    if (trial.evened_vertices == fit.evened_vertices) return std::nullopt;
    std::optional<WallFit> raised = fitted(std::move(trial));
    const bool pays =
        raised && raised->columns_without_face_tets <= fit.columns_without_face_tets &&
        raised->min_scaled_jacobian - fit.min_scaled_jacobian >
            jacobian_per_area *
                std::max(0.0, raised->reduced_area_fraction() - fit.reduced_area_fraction());
    return pays ? raised : std::nullopt;
  }

  const PipelineResult& r_;
  const SurfaceProjector& projector_;
  ColumnQualities& columns_;
  std::optional<ThicknessFitter> outward_, inward_;
};

// Quads, places and thickness of the wall become those of the fit.
void take_over(WallFit& fit, PipelineResult& r, std::vector<SurfacePoint>& places) {
  r.quads = std::move(fit.quads);
  places = std::move(fit.places);
  r.outward = std::move(fit.outward);
  r.inward = std::move(fit.inward);
  r.columns_without_face_tets = fit.columns_without_face_tets;
  r.evened_vertices = fit.evened_vertices;
}

void check_strictness(const PipelineResult& r, const ThicknessResult& result,
                      const std::string& what) {
  if (result.reduced_area_fraction <= 0.0) return;
  const int v = result.worst_vertex;
  const Vec3& at = r.quads.points[v];
  throw MeshingError(fmt::format(
      "the {} have to be thinner than asked on {:.3g} % of the area, least at ({:.6g}, {:.6g}, "
      "{:.6g}): {:.4g} instead of {:.4g}. Ask for less there, or leave out --thickness-strict",
      what, 100.0 * result.reduced_area_fraction, at.x(), at.y(), at.z(), result.given[v],
      result.asked[v]));
}

void check_strictness(const PipelineResult& r) {
  if (!r.options.thickness_strict) return;
  if (r.outward) check_strictness(r, *r.outward, "layers of the wall");
  if (r.inward) check_strictness(r, *r.inward, "layers in the lumen");
}

}  // namespace

std::vector<double> target_edges(const PipelineResult& r, const std::vector<SurfacePoint>& places) {
  std::vector<double> targets = interpolated_values(r.surface, r.relative_edge, places);
  for (double& target : targets) target *= *r.options.size;
  return targets;
}

void check_layer_options(const PipelineOptions& options) {
  require(options.outward || options.inward, "layers are needed on one side at least");
  if (options.outward) check_side(*options.outward);
  if (options.inward) check_side(*options.inward);
}

void make_wall(PipelineResult& r, std::vector<SurfacePoint>& places,
               const SurfaceProjector& projector, const std::vector<double>& radius) {
  check_field(r, r.options.outward);
  check_field(r, r.options.inward);
  r.radius = radii_of_vertices(r, radius);
  fill_in_defaults(r);
  r.layers = plan_layers(groups_of(r.options.outward, "layer_"),
                         groups_of(r.options.inward, "lumen_layer_"));
  const WallShape shape = shape_of(r, places);
  const std::vector<Vec3> directions = find_directions(r, places, shape);
  ColumnQualities columns;
  WallFit start = not_fitted(r.quads, places, directions);
  r.polishing = polish(start.quads, start.places, start.directions, projector, shape,
                       columns.of(r.quads, directions, shape));
  WallFitter fitter(r, projector, columns);
  WallFit fit;
  try {
    fit = fitter.run(std::move(start));
  } catch (const MeshingError&) {
    // Where there is no room for the wall, polishing chases what it cannot reach.
    if (r.polishing.moved == 0) throw;
    r.polishing = {r.polishing.columns_before, r.polishing.columns_before, 0};
    fit = fitter.run(not_fitted(r.quads, places, directions));
  }
  take_over(fit, r, places);
  check_strictness(r);
  r.target_edge = target_edges(r, places);
  r.quad_quality = quad_quality(r.quads, r.target_edge, r.options.stretch);
  std::vector<std::string> names;
  for (const Opening& opening : r.openings) names.push_back(opening.name);
  r.wall = extrude(r.quads, fit.directions, names, fit.shape);
  r.wall_scaled_jacobian = scaled_jacobians(r.wall);
  r.min_wall_scaled_jacobian =
      *std::min_element(r.wall_scaled_jacobian.begin(), r.wall_scaled_jacobian.end());
}

}  // namespace hexwall
