#include "surface/repair.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "core/cancel.h"
#include "core/errors.h"
#include "surface/connectivity.h"
#include "surface/repair_steps.h"
#include "surface/surface_distance.h"

namespace hexwall {
namespace {

using repair::Outcome;
using repair::State;

constexpr std::array<std::pair<RepairStep, std::string_view>, 10> step_names{
    {{RepairStep::weld, "weld"},
     {RepairStep::degenerate, "degenerate"},
     {RepairStep::duplicate, "duplicate"},
     {RepairStep::nonmanifold, "nonmanifold"},
     {RepairStep::components, "components"},
     {RepairStep::orient, "orient"},
     {RepairStep::pinholes, "pinholes"},
     {RepairStep::slivers, "slivers"},
     {RepairStep::remesh, "remesh"},
     {RepairStep::intersections, "intersections"}}};

// Of the bounding box' diagonal: single-precision coordinates differ by 1e-7 of their size, and no
// detail of a vessel is this small.
constexpr double weld_distance = 1e-6;

// Of the mean edge length: detail below is not resolved by the surface.
constexpr double default_tolerance = 0.5;

constexpr std::size_t shown_places = 3;

void require(bool holds, const std::string& message) {
  if (!holds) throw UsageError(message);
}

void check_options(const RepairOptions& options) {
  const auto positive = [](const std::optional<double>& value) {
    return !value || (*value > 0.0 && std::isfinite(*value));
  };
  require(positive(options.tolerance), "the tolerance of the repair must be a positive length");
  require(options.pinhole_length.value_or(0.0) >= 0.0, "the length of pinholes can't be negative");
  require(options.small_component >= 0.0 && options.small_component < 1.0,
          "the share of small components must be at least 0 and below 1");
  require(positive(options.remesh_edge), "the edge length to remesh with must be positive");
}

std::string with_places(const std::string& text, const std::vector<Vec3>& places) {
  std::string result = text + ", near ";
  for (std::size_t i = 0; i < std::min(places.size(), shown_places); ++i) {
    result += (i > 0 ? "; " : "") + coordinates(places[i]);
  }
  return result + (places.size() > shown_places ? "; and more" : "");
}

/// The result as it grows, step by step.
class Repair {
 public:
  Repair(const TriangleSurface& surface, const RepairOptions& options) : options_(options) {
    state_.surface = surface;
    state_.origin.resize(surface.triangles.size());
    std::iota(state_.origin.begin(), state_.origin.end(), 0);
  }

  /// Runs a step if it is switched on. A step without a finding leaves everything as it was.
  void run(RepairStep step, const std::function<Outcome(State&)>& work) {
    const auto& steps = options_.steps;
    if (std::find(steps.begin(), steps.end(), step) == steps.end()) return;
    throw_if_cancelled();
    State next = state_;
    Outcome outcome = work(next);
    if (outcome.places.empty()) return;
    state_ = std::move(next);
    actions_.push_back({step, static_cast<int>(outcome.places.size()),
                        with_places(outcome.text, outcome.places), std::move(outcome.places)});
  }

  const TriangleSurface& surface() const { return state_.surface; }

  RepairResult result() && {
    return {std::move(state_.surface), std::move(state_.origin), std::move(actions_)};
  }

 private:
  const RepairOptions& options_;
  State state_;
  std::vector<RepairAction> actions_;
};

bool has_finite_triangles(const TriangleSurface& surface) {
  return std::all_of(surface.triangles.begin(), surface.triangles.end(), [&](const auto& t) {
    return std::all_of(t.begin(), t.end(), [&](int v) { return surface.points[v].allFinite(); });
  });
}

bool have_area(const TriangleSurface& surface) {
  for (int f = 0; f < static_cast<int>(surface.triangles.size()); ++f) {
    if (!has_area(surface, f)) return false;
  }
  return !surface.triangles.empty();
}

std::optional<Connectivity> connectivity_if_manifold(const TriangleSurface& surface) {
  try {
    return connectivity_of(surface);
  } catch (const TopologyError&) {
    return std::nullopt;
  }
}

const double* pointer_to(const std::optional<double>& value) {
  return value ? &*value : nullptr;
}

}  // namespace

std::string_view name(RepairStep step) {
  return std::find_if(step_names.begin(), step_names.end(),
                      [step](const auto& entry) { return entry.first == step; })
      ->second;
}

RepairStep repair_step_from_name(std::string_view name) {
  std::string known;
  for (const auto& [step, step_name] : step_names) {
    if (step_name == name) return step;
    known += fmt::format(" {}", step_name);
  }
  throw UsageError(fmt::format("unknown repair step '{}'; known are{}", name, known));
}

std::vector<RepairStep> all_repair_steps() {
  std::vector<RepairStep> steps;
  for (const auto& entry : step_names) steps.push_back(entry.first);
  return steps;
}

RepairResult repair_topology(const TriangleSurface& surface, const RepairOptions& options) {
  check_options(options);
  Repair repair(surface, options);
  if (!has_finite_triangles(surface)) return std::move(repair).result();
  const double distance = weld_distance * bounding_box_diagonal(surface);
  const double small = options.small_component;
  repair.run(RepairStep::weld, [&](State& s) { return repair::weld(s, distance); });
  repair.run(RepairStep::degenerate,
             [&](State& s) { return repair::remove_degenerate(s, distance); });
  repair.run(RepairStep::duplicate, repair::remove_duplicates);
  repair.run(RepairStep::nonmanifold, [&](State& s) { return repair::make_manifold(s, small); });
  repair.run(RepairStep::components,
             [&](State& s) { return repair::keep_largest_component(s, small); });
  repair.run(RepairStep::orient, repair::turn_outward);
  return std::move(repair).result();
}

RepairResult repair_geometry(const TriangleSurface& surface, const RepairOptions& options) {
  check_options(options);
  Repair repair(surface, options);
  if (!has_finite_triangles(surface) || !have_area(surface)) return std::move(repair).result();
  const std::optional<Connectivity> mesh = connectivity_if_manifold(surface);
  if (!mesh) return std::move(repair).result();
  const double tolerance =
      options.tolerance.value_or(default_tolerance * mean_edge_length(surface));
  bool is_free = false;
  repair.run(RepairStep::pinholes, [&](State& s) {
    return repair::fill_pinholes(s, *mesh, pointer_to(options.pinhole_length));
  });
  const TriangleSurface filled = repair.surface();
  repair.run(RepairStep::slivers, [&](State& s) { return repair::remove_slivers(s, tolerance); });
  repair.run(RepairStep::remesh, [&](State& s) {
    return repair::remesh_hopeless(s, pointer_to(options.remesh_edge), tolerance);
  });
  repair.run(RepairStep::intersections,
             [&](State& s) { return repair::resolve_intersections(s, tolerance, is_free); });
  RepairResult result = std::move(repair).result();
  if (result.surface.points != filled.points || result.surface.triangles != filled.triangles) {
    result.moved = surface_distance(filled, result.surface);
  }
  result.is_free_of_intersections = is_free;
  return result;
}

}  // namespace hexwall
