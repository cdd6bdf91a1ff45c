#include "flow/flow_report.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace hexwall {
namespace {

using Json = nlohmann::ordered_json;

constexpr double per_millilitre = 1e6;

Json blood_json(const Blood& blood) {
  Json json = {
      {"model", name(blood.model)}, {"density", blood.density}, {"viscosity", blood.viscosity}};
  if (blood.model == FluidModel::newtonian) return json;
  json["viscosity_at_rest"] = blood.viscosity_at_rest;
  json["relaxation_time"] = blood.relaxation_time;
  json["power"] = blood.power;
  return json;
}

void append_line(std::string& text, const char* label, const std::string& content) {
  text += fmt::format("  {:<10} {}\n", label, content);
}

}  // namespace

Json flow_json(const FlowSetup& setup) {
  Json outlets = Json::array();
  for (const FlowOutlet& outlet : setup.outlets) {
    outlets.push_back({{"patch", outlet.patch},
                       {"area", outlet.area},
                       {"radius", outlet.radius},
                       {"share", outlet.share},
                       {"fixes_pressure", outlet.fixes_pressure}});
  }
  Json json = {
      {"kind", setup.pulse ? "pulsatile" : "steady"},
      {"fluid", blood_json(setup.blood)},
      {"flow_rate", setup.flow_rate},
      {"velocity", setup.velocity},
      {"reynolds", setup.reynolds},
      {"inlet",
       {{"patch", setup.inlet}, {"area", setup.inlet_area}, {"diameter", setup.inlet_diameter}}},
      {"outlets", outlets}};
  if (setup.pulse) {
    json["pulse"] = {{"period", setup.pulse->period},
                     {"cycles", setup.pulse->cycles},
                     {"womersley", setup.pulse->womersley},
                     {"peak_reynolds", setup.pulse->peak_reynolds}};
  }
  json["warnings"] = setup.warnings;
  return json;
}

std::string flow_summary(const FlowSetup& setup) {
  std::string text;
  append_line(text, "inlet",
              fmt::format("{}: Re {:.0f}, {:.4g} mL/s, {:.3g} m/s, diameter {:.3g} mm", setup.inlet,
                          setup.reynolds, setup.flow_rate * per_millilitre, setup.velocity,
                          setup.inlet_diameter * 1e3));
  if (setup.pulse) {
    append_line(text, "pulse",
                fmt::format("{} cycles of {:.3g} s, peak Re {:.0f}, Womersley number {:.2f}",
                            setup.pulse->cycles, setup.pulse->period, setup.pulse->peak_reynolds,
                            setup.pulse->womersley));
  }
  for (const FlowOutlet& outlet : setup.outlets) {
    append_line(text, "outlet",
                fmt::format("{}: {:.1f} % of the flow, diameter {:.3g} mm{}", outlet.patch,
                            100.0 * outlet.share, 2e3 * outlet.radius,
                            outlet.fixes_pressure ? ", pressure 0" : ""));
  }
  for (const std::string& warning : setup.warnings) append_line(text, "warning", warning);
  return text;
}

}  // namespace hexwall
