#include "surface/prepare.h"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include "surface/check.h"
#include "surface/connectivity.h"
#include "surface/extend.h"
#include "surface/loop_plane.h"
#include "surface/loop_shape.h"
#include "surface/units.h"

namespace hexwall {
namespace {

void add_repairs(const RepairResult& repaired, PrepareResult& result) {
  for (const RepairAction& action : repaired.actions) {
    result.notes.push_back(action.text);
    result.repairs.push_back(action);
  }
  result.moved = std::max(result.moved, repaired.moved);
}

// Loops by falling length, so that names do not depend on the file's order.
std::vector<int> longest_first(const TriangleSurface& surface, const Connectivity& mesh) {
  std::vector<double> lengths;
  for (const auto& loop : mesh.loops()) {
    lengths.push_back(loop_shape(points_of(surface, loop)).length);
  }
  std::vector<int> order(lengths.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return lengths[a] > lengths[b]; });
  return order;
}

// Gives opened caps the names of their openings, in the notes as well.
void name_opened(const std::vector<Vec3>& centers, const std::vector<std::string>& names,
                 PrepareResult& result) {
  for (OpenedCap& cap : result.opened) {
    const auto nearest =
        std::min_element(centers.begin(), centers.end(), [&](const Vec3& a, const Vec3& b) {
          return (a - cap.center).squaredNorm() < (b - cap.center).squaredNorm();
        });
    if ((*nearest - cap.center).norm() > cap.radius) continue;  // it was closed by a later step
    const std::string former = describe(cap);
    cap.name = names[nearest - centers.begin()];
    std::replace(result.notes.begin(), result.notes.end(), former, describe(cap));
  }
}

// Names the openings and lengthens them. `openings` gets the centres of the final loops.
// \param mesh of the surface as it is.
void name_and_extend(const PrepareOptions& options, const Connectivity& mesh,
                     PrepareResult& result) {
  const std::vector<int> order = longest_first(result.surface, mesh);
  std::vector<Vec3> centers;
  std::vector<double> radii;
  for (const int loop : order) {
    const LoopPlane plane = fit_plane(points_of(result.surface, mesh.loops()[loop]));
    centers.push_back(plane.center);
    radii.push_back(plane.radius);
  }
  std::vector<NamedPlace> of_caps;
  for (const OpenedCap& cap : result.opened) {
    if (!cap.name.empty()) of_caps.push_back({cap.name, cap.center});
  }
  const std::vector<std::string> names = assign_names(centers, radii, options.names, of_caps);
  name_opened(centers, names, result);
  if (options.extend > 0.0) {
    ExtendResult extended = extend_openings(result.surface, options.extend);
    result.surface = std::move(extended.surface);
    const Connectivity longer = connectivity_of(result.surface);
    for (std::size_t i = 0; i < order.size(); ++i) {
      const int loop = longer.loop_of_vertex(extended.end_vertex[order[i]]);
      centers[i] = fit_plane(points_of(result.surface, longer.loops()[loop])).center;
    }
    std::vector<int> number(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) number[order[i]] = static_cast<int>(i);
    result.extension = std::move(extended.extension);
    for (int& e : result.extension) e = e < 0 ? e : number[e];
    for (std::size_t i = 0; i < order.size(); ++i) {
      result.notes.push_back(fmt::format("{}: {}", names[i], extended.notes[order[i]]));
    }
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    result.openings.push_back({names[i], centers[i]});
  }
}

}  // namespace

PrepareResult repair_and_open(const ReadResult& input, const PrepareOptions& options,
                              bool& is_free_of_intersections) {
  PrepareResult result;
  result.notes = input.notes;
  RepairResult topology = repair_topology(input.surface, options.repair);
  add_repairs(topology, result);
  OpenResult open =
      open_surface(topology.surface, follow(input.cell_arrays, topology.origin), options.open);
  result.opened = std::move(open.caps);
  result.notes.insert(result.notes.end(), open.notes.begin(), open.notes.end());
  RepairResult geometry = repair_geometry(open.surface, options.repair);
  add_repairs(geometry, result);
  result.surface = std::move(geometry.surface);
  is_free_of_intersections = geometry.is_free_of_intersections;
  return result;
}

namespace {

PrepareResult finish(PrepareResult result, const PrepareOptions& options,
                     bool is_free_of_intersections) {
  CheckResult checked = check_surface(result.surface, is_free_of_intersections);
  result.surface = std::move(checked.surface);
  result.notes.insert(result.notes.end(), checked.notes.begin(), checked.notes.end());
  if (auto warning = unit_warning(result.surface, checked.mesh, options.metres_per_unit)) {
    result.warnings.push_back(std::move(*warning));
  }
  result.extension.assign(result.surface.triangles.size(), -1);
  name_and_extend(options, checked.mesh, result);
  return result;
}

}  // namespace

PrepareResult prepare_surface(const ReadResult& input, const PrepareOptions& options) {
  bool is_free_of_intersections = false;
  PrepareResult result = repair_and_open(input, options, is_free_of_intersections);
  return finish(std::move(result), options, is_free_of_intersections);
}

PrepareResult use_as_it_is(const TriangleSurface& surface, const PrepareOptions& options) {
  PrepareResult result;
  result.surface = surface;
  return finish(std::move(result), options, false);
}

}  // namespace hexwall
