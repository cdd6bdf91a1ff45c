#include "case_command.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "exporters/openfoam_case.h"
#include "exporters/output_file.h"
#include "flow/flow_report.h"
#include "flow/flow_setup.h"
#include "lumen/lumen.h"
#include "output_folder.h"
#include "report.h"
#include "surface_command.h"

namespace hexwall {
namespace {

constexpr double cubic_metres_per_millilitre = 1e-6;

struct CaseOptions {
  SurfaceCommandOptions surface;
  LumenOptions lumen;
  std::string mesh = "hybrid";
  std::string flow = "steady";
  std::string fluid = "newtonian";
  std::optional<double> flow_rate;  ///< mL/s
  std::vector<std::string> split;   ///< NAME=SHARE
  std::string waveform;
  FlowOptions setup;
  int processes = 1;
};

std::map<std::string, double> shares(const std::vector<std::string>& split) {
  std::map<std::string, double> result;
  for (const std::string& entry : split) {
    const std::size_t sign = entry.rfind('=');
    const std::string number = sign == std::string::npos ? "" : entry.substr(sign + 1);
    std::size_t used = 0;
    double share = 0.0;
    try {
      share = std::stod(number, &used);
    } catch (const std::exception&) {
      used = 0;
    }
    if (used == 0 || used != number.size())
      throw UsageError(fmt::format("--split: '{}' is not NAME=SHARE", entry));
    if (!result.emplace(entry.substr(0, sign), share).second)
      throw UsageError(fmt::format("--split: '{}' is there twice", entry.substr(0, sign)));
  }
  return result;
}

FlowOptions flow_options(const CaseOptions& c) {
  FlowOptions options = c.setup;
  options.pulsatile = c.flow == "pulsatile";
  options.blood.model = c.fluid == "carreau" ? FluidModel::carreau : FluidModel::newtonian;
  if (c.flow_rate) options.flow_rate = *c.flow_rate * cubic_metres_per_millilitre;
  options.split = shares(c.split);
  if (c.waveform.empty()) return options;
  if (!options.pulsatile) throw UsageError("--waveform goes with --flow pulsatile");
  options.waveform = read_waveform(c.waveform);
  for (double& flow : options.waveform->flows) flow *= cubic_metres_per_millilitre;
  return options;
}

nlohmann::ordered_json case_json(const CaseOptions& c, const LumenResult& lumen,
                                 const FlowSetup& setup) {
  return {{"hexwall_version", version()},
          {"surface", c.surface.input.surface},
          {"units", c.surface.input.units},
          {"metres_per_unit", metres_per_unit(c.surface.input.units)},
          {"mesh",
           {{"kind", c.mesh},
            {"cells", lumen.mesh.cells()},
            {"points", lumen.mesh.points.size()},
            {"hexahedra", lumen.counts.hexes},
            {"pyramids", lumen.counts.pyramids},
            {"tetrahedra", lumen.counts.tets}}},
          {"processes", c.processes},
          {"flow", flow_json(setup)}};
}

ExitCode run_case(const CaseOptions& c) {
  spdlog::logger log = make_logger(c.surface);
  const auto limit = limit_threads(c.surface);
  const FlowOptions flow = flow_options(c);
  OutputFolder folder(c.surface.output);
  SurfaceRun run = run_surface(c.surface);
  LumenOptions lumen_options = c.lumen;
  lumen_options.mesh = c.mesh == "tet" ? LumenOptions::Mesh::tet : LumenOptions::Mesh::hybrid;
  const LumenResult lumen = make_lumen(run.result, lumen_options);
  const double metres = metres_per_unit(c.surface.input.units);
  const FlowSetup setup = set_up_flow(lumen.mesh, lumen.openings, flow, metres);
  write_openfoam_case(folder.staging(), lumen.mesh, setup, {metres, c.processes});
  write_output_file(folder.staging() / "case.json", case_json(c, lumen, setup).dump(2) + "\n");
  folder.commit();
  log_notes(log, run.prepared);
  log.info("  {:<10} {} hexahedra, {} pyramids, {} tetrahedra", "mesh", lumen.counts.hexes,
           lumen.counts.pyramids, lumen.counts.tets);
  for (const std::string& warning : lumen.warnings) log.info("  {:<10} {}", "warning", warning);
  log.info("{}  {:<10} {}", flow_summary(setup), "run", (folder.path() / "Allrun").string());
  log_times(log, run);
  return ExitCode::success;
}

void add_flow_options(CLI::App& command, CaseOptions& c) {
  const std::string group = "Flow";
  const auto add = [&](const char* name, auto& value, const char* text) {
    return command.add_option(name, value, text)->group(group);
  };
  add("--flow", c.flow, "steady, or pulsatile by --waveform")
      ->check(CLI::IsMember({"steady", "pulsatile"}))
      ->capture_default_str();
  CLI::Option* re = add("--re", c.setup.reynolds,
                        "Reynolds number at the inlet, of the mean flow if pulsatile [300]");
  add("--flow-rate", c.flow_rate, "Flow rate in mL/s instead")->excludes(re);
  add("--fluid", c.fluid, "newtonian or carreau")
      ->check(CLI::IsMember({"newtonian", "carreau"}))
      ->capture_default_str();
  add("--density", c.setup.blood.density, "Density in kg/m³")->capture_default_str();
  add("--viscosity", c.setup.blood.viscosity,
      "Viscosity in Pa s; of carreau, that at infinite shear rate")
      ->capture_default_str();
  add("--inlet", c.lumen.inlet, "Name of the inlet [the largest opening]");
  add("--split", c.split,
      "Share of each outlet, NAME=SHARE separated by commas [radius cubed: Murray]")
      ->delimiter(',');
  CLI::Option* waveform =
      add("--waveform", c.waveform,
          "File with a time in s and a flow rate in mL/s on each line [a typical pulse]");
  add("--period", c.setup.period, "Of the typical pulse, in s")
      ->excludes(waveform)
      ->capture_default_str();
  add("--cycles", c.setup.cycles, "Cycles to run; the last one is averaged")->capture_default_str();
  add("--procs", c.processes, "Processes that Allrun runs the solver in")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
}

}  // namespace

Command add_case(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("case", "Make an OpenFOAM case of the flow in a vessel, ready to run");
  const auto c = std::make_shared<CaseOptions>();
  c->surface.layers.side = "in";
  add_surface_options(*command, c->surface);
  add_layer_options(*command, c->surface.layers);
  command->add_option("--mesh", c->mesh, "hybrid: hexes at the wall; tet: tetrahedra only")
      ->check(CLI::IsMember({"hybrid", "tet"}))
      ->capture_default_str();
  command
      ->add_option("--core-growth", c->lumen.core_growth,
                   "Edges of tetrahedra grow by this share of the distance from the wall")
      ->capture_default_str();
  add_flow_options(*command, *c);
  return {command, [c] { return run_case(*c); }};
}

}  // namespace hexwall
