#include "lumen/lumen_report.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace hexwall {
namespace {

using Json = nlohmann::ordered_json;

Json place_json(const Vec3& p) {
  return Json::array({p.x(), p.y(), p.z()});
}

Json worst_json(const Worst& worst) {
  return {{"worst", worst.value}, {"at", place_json(worst.at)}};
}

Json quality_json(const std::string& region, const CellQuality& q) {
  Json json = {{"name", region},
               {"volume", q.volume},
               {"least_cell_volume", q.least_volume},
               {"non_orthogonality_deg", worst_json(q.non_orthogonality)},
               {"skewness", worst_json(q.skewness)},
               {"aspect_ratio", worst_json(q.aspect_ratio)},
               {"volume_ratio", worst_json(q.volume_ratio)}};
  json["non_orthogonality_deg"]["mean"] = q.mean_non_orthogonality;
  json["non_orthogonality_deg"]["faces_above_70"] = q.faces_above_70;
  return json;
}

Json openings_json(const std::vector<LumenOpening>& openings) {
  Json list = Json::array();
  for (const LumenOpening& opening : openings) {
    list.push_back({{"name", opening.patch},
                    {"inlet", opening.inlet},
                    {"area", opening.area},
                    {"radius", opening.radius},
                    {"center", place_json(opening.center)},
                    {"normal", place_json(opening.normal)}});
  }
  return list;
}

void append_line(std::string& text, const std::string& label, const std::string& content) {
  text += fmt::format("  {:<10} {}\n", label, content);
}

}  // namespace

nlohmann::ordered_json lumen_json(const LumenResult& r) {
  Json zones = Json::array();
  for (const CellGroup& zone : r.mesh.zones) {
    zones.push_back({{"name", zone.name}, {"cells", zone.cells.size()}});
  }
  Json patches = Json::array();
  for (const CellPatch& patch : r.mesh.patches) {
    patches.push_back({{"name", patch.name}, {"faces", patch.faces.size()}});
  }
  Json regions = Json::array();
  for (std::size_t i = 0; i < r.quality.size(); ++i) {
    regions.push_back(quality_json(r.mesh.regions[i].name, r.quality[i]));
  }
  Json seconds = {{"tetgen", r.tetgen_seconds}};
  for (const StageTime& time : r.times) seconds[time.stage] = time.seconds;
  return {{"cells", r.mesh.cells()},
          {"points", r.mesh.points.size()},
          {"hexahedra", r.counts.hexes},
          {"pyramids", r.counts.pyramids},
          {"tetrahedra", r.counts.tets},
          {"lowered_pyramids", r.lowered_pyramids},
          {"moved_vertices", r.improvement.moved},
          {"reconnected", r.improvement.reconnected},
          {"openings", openings_json(r.openings)},
          {"zones", std::move(zones)},
          {"patches", std::move(patches)},
          {"regions", std::move(regions)},
          {"seconds", std::move(seconds)},
          {"tetgen_peak_memory_bytes", r.tetgen_memory_bytes},
          {"warnings", r.warnings}};
}

std::string lumen_summary(const LumenResult& r, const std::string& units) {
  std::string text;
  append_line(text, "cells",
              fmt::format("{}: {} hexahedra, {} pyramids, {} tetrahedra", r.mesh.cells(),
                          r.counts.hexes, r.counts.pyramids, r.counts.tets));
  for (std::size_t i = 0; i < r.quality.size(); ++i) {
    const CellQuality& q = r.quality[i];
    append_line(text, r.mesh.regions[i].name,
                fmt::format("non-orthogonality {:.1f} deg (mean {:.1f}), skewness {:.2f}, aspect "
                            "ratio {:.1f}, volume {:.6g} {}^3",
                            q.non_orthogonality.value, q.mean_non_orthogonality, q.skewness.value,
                            q.aspect_ratio.value, q.volume, units));
  }
  for (const std::string& warning : r.warnings) append_line(text, "warning", warning);
  return text;
}

std::string openings_summary(const LumenResult& r, const std::string& units) {
  std::string text;
  for (const LumenOpening& opening : r.openings) {
    append_line(text, opening.inlet ? "inlet" : "outlet",
                fmt::format("{}: area {:.5g} {}^2", opening.patch, opening.area, units));
  }
  return text;
}

}  // namespace hexwall
