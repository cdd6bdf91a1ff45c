#include "report.h"

#include <algorithm>
#include <numbers>
#include <sys/resource.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "surface/counted.h"
#include "surface/triangle_surface.h"

namespace hexwall {
namespace {

using Json = nlohmann::ordered_json;

constexpr int report_version = 1;

Json vector_json(const Vec3& p) {
  return Json::array({p.x(), p.y(), p.z()});
}

std::string poles_text(const PoleRequest& poles) {
  switch (poles.mode) {
    case PoleRequest::Mode::automatic:
      return "auto";
    case PoleRequest::Mode::off:
      return "off";
    case PoleRequest::Mode::count:
      return std::to_string(poles.count);
    default:
      return "places";
  }
}

Json poles_json(const PipelineResult& r) {
  Json poles = Json::array();
  for (std::size_t i = 0; i < r.poles.size(); ++i) {
    const PoleStep& pole = r.poles[i];
    poles.push_back({{"center", vector_json(pole.disk.center.position)},
                     {"radius", pole.disk.radius},
                     {"quads_around", r.pole_caps[i].around},
                     {"energy_before", pole.energy_before},
                     {"energy_after", pole.energy_after},
                     {"off_size_area_fraction_before", pole.off_share_before},
                     {"off_size_area_fraction_after", pole.off_share_after}});
  }
  return poles;
}

Json layer_options_json(const LayerOptions& o) {
  Json json = Json::object();
  if (o.thickness) json["thickness"] = *o.thickness;
  if (o.thickness_ratio) json["thickness_ratio"] = *o.thickness_ratio;
  json["thickness_field"] = !o.thickness_field.empty();
  if (o.thickness_min) json["thickness_min"] = *o.thickness_min;
  if (o.thickness_max) json["thickness_max"] = *o.thickness_max;
  if (o.groups.empty()) {
    json["layers"] = o.layers;
    json["growth"] = o.growth;
    return json;
  }
  for (const LayerGroup& group : o.groups) {
    json["layer_spec"].push_back(
        {{"name", group.name}, {"share", group.share}, {"cells", group.cells}});
  }
  return json;
}

Json options_json(const PipelineOptions& options, const std::string& units) {
  Json json = {{"size", *options.size},
               {"stretch", options.stretch},
               {"relax", options.relax},
               {"size_by_radius", options.size_by_radius},
               {"size_field", !options.size_field.empty()},
               {"poles", poles_text(options.poles)},
               {"units", units},
               {"thickness_strict", options.thickness_strict}};
  if (options.outward) json["outward"] = layer_options_json(*options.outward);
  if (options.inward) json["inward"] = layer_options_json(*options.inward);
  return json;
}

Json input_json(const PipelineResult& r, const ReportContext& context) {
  Json loops = Json::array();
  for (const Opening& opening : r.openings) {
    loops.push_back({{"name", opening.name},
                     {"length", opening.length},
                     {"radius", opening.plane.radius},
                     {"center", vector_json(opening.plane.center)},
                     {"normal", vector_json(opening.plane.normal)},
                     {"planar", opening.plane.is_planar()}});
  }
  return {
      {"file", context.input_file},    {"vertices", context.vertices},
      {"faces", context.faces},        {"loops", r.openings.size()},
      {"area", total_area(r.surface)}, {"bounding_box_diagonal", bounding_box_diagonal(r.surface)},
      {"openings", std::move(loops)},  {"notes", context.prepared->notes}};
}

Json energy_json(const OptimumResult& optimum) {
  Json starts = Json::array();
  for (const Descent& descent : optimum.descents) {
    std::string signs;
    for (const int sign : descent.signs) signs += sign > 0 ? '+' : '-';
    starts.push_back({{"signs", signs},
                      {"energy", descent.energy},
                      {"iterations", descent.iterations.size() - 1}});
  }
  return {{"normalized", optimum.energy},
          {"best_start", optimum.best},
          {"iterations", optimum.descents[optimum.best].iterations},
          {"starts", std::move(starts)}};
}

Json foliation_json(const PipelineResult& r) {
  std::vector<double> circumferences;
  std::vector<double> heights;
  for (const Cylinder& c : r.foliation.cylinders) {
    circumferences.push_back(c.circumference());
    heights.push_back(c.height());
  }
  std::vector<double> periods(r.solution.form.periods.begin(), r.solution.form.periods.end());
  return {{"zeros",
           {{"interior", r.foliation.interior_zeros()},
            {"boundary_halves", r.foliation.boundary_half_zeros()},
            {"total_order", 0.5 * r.foliation.doubled_order()}}},
          {"periods", std::move(periods)},
          {"cylinders",
           {{"count", r.foliation.cylinders.size()},
            {"circumference", std::move(circumferences)},
            {"height", std::move(heights)},
            {"quads_along", r.numbers.along}}},
          {"strips",
           {{"count", r.foliation.strips.count()},
            {"width", r.foliation.strips.width},
            {"quads_across", r.numbers.across}}},
          {"corrected_level_curves", r.foliation.corrected_arcs() + r.conformal.corrected_levels}};
}

Json quads_json(const PipelineResult& r) {
  const QuadQuality& quality = r.quad_quality;
  const auto& quantiles = quality.edge_length_quantiles;
  return {{"count", r.quads.quads.size()},
          {"vertices", r.quads.points.size()},
          {"irregular", quality.irregular},
          {"angle_stddev_deg", quality.angle_stddev_deg},
          {"min_scaled_jacobian", quality.min_scaled_jacobian},
          {"edge_length_quantiles",
           {{"1%", quantiles[0]},
            {"5%", quantiles[1]},
            {"50%", quantiles[2]},
            {"95%", quantiles[3]},
            {"99%", quantiles[4]}}},
          {"off_size_area_fraction", quality.off_size_area_fraction},
          {"area_fraction", quality.area / total_area(r.surface)},
          {"relax_iterations", r.relaxation.iterations},
          {"polished",
           {{"columns_before", r.polishing.columns_before},
            {"columns_after", r.polishing.columns_after},
            {"vertices_moved", r.polishing.moved},
            {"vertices_evened", r.evened_vertices}}}};
}

Json side_json(const PipelineResult& r, const ThicknessResult& side) {
  const auto [asked_min, asked_max] = std::minmax_element(side.asked.begin(), side.asked.end());
  const auto [given_min, given_max] = std::minmax_element(side.given.begin(), side.given.end());
  const int worst = side.worst_vertex;
  Json json = {{"thickness_asked", {{"min", *asked_min}, {"max", *asked_max}}},
               {"thickness_given", {{"min", *given_min}, {"max", *given_max}}},
               {"reduced_area_fraction", side.reduced_area_fraction},
               {"colliding_quads", side.colliding_quads}};
  if (side.reduced_area_fraction > 0.0) {
    json["worst"] = {{"at", vector_json(r.quads.points[worst])},
                     {"asked", side.asked[worst]},
                     {"given", side.given[worst]}};
  }
  return json;
}

Json wall_json(const PipelineResult& r) {
  Json zones = Json::array();
  for (const CellGroup& zone : r.wall.zones) {
    zones.push_back({{"name", zone.name}, {"hexes", zone.cells.size()}});
  }
  Json json = {{"hexes", r.wall.cells()},
               {"vertices", r.wall.points.size()},
               {"layers", r.layers.layers()},
               {"zones", std::move(zones)},
               {"min_scaled_jacobian", r.min_wall_scaled_jacobian},
               {"columns_without_face_tets", r.columns_without_face_tets},
               {"smoothed_directions", r.smoothed_directions}};
  if (r.outward) json["outward"] = side_json(r, *r.outward);
  if (r.inward) json["inward"] = side_json(r, *r.inward);
  return json;
}

Json seconds_json(const PipelineResult& r, const ReportContext& context) {
  double total = 0.0;
  Json json = {{"total", 0.0}};
  for (const auto* times : {&context.io_times, &r.times}) {
    for (const StageTime& time : *times) {
      json[time.stage] = time.seconds;
      total += time.seconds;
    }
  }
  json["total"] = total;
  return json;
}

// Between which bounds the layers of a side are thick.
std::string side_text(const ThicknessResult& side, const std::string& units) {
  const auto [least, greatest] = std::minmax_element(side.given.begin(), side.given.end());
  const std::string least_text = fmt::format("{:.4g}", *least);
  const std::string greatest_text = fmt::format("{:.4g}", *greatest);
  return least_text == greatest_text
             ? fmt::format("{} {} thick", least_text, units)
             : fmt::format("{} to {} {} thick", least_text, greatest_text, units);
}

}  // namespace

nlohmann::ordered_json preparation_json(const PrepareResult& prepared) {
  Json repairs = Json::array();
  for (const RepairAction& action : prepared.repairs) {
    repairs.push_back(
        {{"step", std::string(name(action.step))}, {"count", action.count}, {"text", action.text}});
  }
  Json opened = Json::array();
  for (const OpenedCap& cap : prepared.opened) {
    opened.push_back({{"name", cap.name},
                      {"how", cap.how},
                      {"center", vector_json(cap.center)},
                      {"normal", vector_json(cap.normal)},
                      {"radius", cap.radius},
                      {"area", cap.area}});
  }
  const auto extended = std::count_if(prepared.extension.begin(), prepared.extension.end(),
                                      [](int e) { return e >= 0; });
  return {{"vertices", prepared.surface.points.size()},
          {"faces", prepared.surface.triangles.size()},
          {"repairs", std::move(repairs)},
          {"distance_moved", prepared.moved},
          {"opened", std::move(opened)},
          {"extension_faces", extended}};
}

nlohmann::ordered_json make_report(const PipelineResult& r, const ReportContext& context) {
  Json report;
  report["report_version"] = report_version;
  report["hexwall_version"] = version();
  report["options"] = options_json(r.options, context.units);
  report["input"] = input_json(r, context);
  report["preparation"] = preparation_json(*context.prepared);
  report["refined"] = {{"vertices", r.solution.refined.surface.points.size()},
                       {"faces", r.solution.refined.surface.triangles.size()},
                       {"splits", r.solution.refined.splits},
                       {"flips", r.solution.refined.flips},
                       {"negative_edges", r.solution.refined.negative_edges}};
  report["basis"] = {{"forms", r.solution.basis.size()},
                     {"error", r.solution.form.error},
                     {"factor_nonzeros", r.solution.factor_nonzeros}};
  report["energy"] = energy_json(r.solution.optimum);
  report["energy"]["off_size_area_fraction"] = r.solution.off_size_share;
  report["poles"] = poles_json(r);
  report.update(foliation_json(r));
  report["quads"] = quads_json(r);
  report["wall"] = wall_json(r);
  report["seconds"] = seconds_json(r, context);
  report["peak_memory_bytes"] = peak_memory_bytes();
  report["warnings"] = r.warnings;
  return report;
}

std::string summary(const PipelineResult& r, const std::string& units) {
  std::string text;
  const auto line = [&](const std::string& label, const std::string& value) {
    text += fmt::format("  {:<10} {}\n", label, value);
  };
  line("surface", fmt::format("{} vertices, {} triangles, {} openings", r.surface.points.size(),
                              r.surface.triangles.size(), r.openings.size()));
  line("form", fmt::format("energy {:.4f}, basis error {:.1e}, zeros of order {} in all, {}, {}",
                           r.solution.optimum.energy, r.solution.form.error,
                           0.5 * r.foliation.doubled_order(),
                           counted(r.foliation.cylinders.size(), "cylinder"),
                           counted(r.foliation.strips.count(), "strip")));
  for (const PoleStep& pole : r.poles) {
    const Vec3& at = pole.disk.center.position;
    line("pole", fmt::format("at ({:.4g}, {:.4g}, {:.4g}): area more than 2x off in size {:.1f} % "
                             "-> {:.1f} %, energy {:.3f} -> {:.3f}",
                             at.x(), at.y(), at.z(), 100.0 * pole.off_share_before,
                             100.0 * pole.off_share_after, pole.energy_before, pole.energy_after));
  }
  line("quads",
       fmt::format("{}, {}, corner angles 90 +- {:.2f} deg, "
                   "min scaled Jacobian {:.3f}",
                   r.quads.quads.size(),
                   counted(r.quad_quality.irregular, "irregular vertex", "irregular vertices"),
                   r.quad_quality.angle_stddev_deg, r.quad_quality.min_scaled_jacobian));
  line("hexes", fmt::format("{} in {} layers, min scaled Jacobian {:.3f}", r.wall.cells(),
                            r.layers.layers(), r.min_wall_scaled_jacobian));
  if (r.outward) line("wall", side_text(*r.outward, units));
  if (r.inward) line("lumen", side_text(*r.inward, units));
  for (const Opening& opening : r.openings) {
    line(opening.name,
         fmt::format("radius {:.4g} {} at ({:.4g}, {:.4g}, {:.4g})",
                     opening.length / (2.0 * std::numbers::pi), units, opening.plane.center.x(),
                     opening.plane.center.y(), opening.plane.center.z()));
  }
  for (const std::string& warning : r.warnings) line("warning", warning);
  return text;
}

long peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss * 1024;  // Linux gives kibibytes
}

std::string version() {
  return HEXWALL_VERSION;
}

}  // namespace hexwall
