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
#include "lumen/lumen_report.h"
#include "lumen_command.h"
#include "output_folder.h"
#include "report.h"

namespace hexwall {
namespace {

constexpr double cubic_metres_per_millilitre = 1e-6;

struct CaseOptions {
  LumenCommandOptions lumen;
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

// The report of the mesh, and what flows.
std::string report(LumenRun& run, const FlowSetup& setup, const InputOptions& input) {
  run.surface.context.prepared = &run.surface.prepared;
  nlohmann::ordered_json json = make_report(run.surface.result, run.surface.context);
  json["lumen"] = lumen_json(run.lumen);
  json["flow"] = flow_json(setup);
  json["flow"]["metres_per_unit"] = metres_per_unit(input.units);
  return json.dump(2) + "\n";
}

ExitCode run_case(const CaseOptions& c) {
  const SurfaceCommandOptions& surface = c.lumen.surface;
  if (surface.layers.side != "in")
    throw UsageError("a case is of the lumen alone: --side in, which is the default");
  spdlog::logger log = make_logger(surface);
  const auto limit = limit_threads(surface);
  const FlowOptions flow = flow_options(c);
  OutputFolder folder(surface.output);
  LumenRun run = run_lumen(c.lumen);
  const CellMesh& mesh = run.lumen.mesh;
  const double metres = metres_per_unit(surface.input.units);
  const FlowSetup setup = set_up_flow(mesh, run.lumen.openings, flow, metres);
  write_openfoam_case(folder.staging(), mesh, setup, {metres, c.processes});
  write_output_file(folder.staging() / "report.json", report(run, setup, surface.input));
  folder.commit();
  log_notes(log, run.surface.prepared);
  log.info("{}{}{}  {:<10} {}", summary(run.surface.result, surface.input.units),
           lumen_summary(run.lumen, surface.input.units), flow_summary(setup), "run",
           (folder.path() / "Allrun").string());
  log_times(log, run.surface);
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
  add_lumen_options(*command, c->lumen);
  add_flow_options(*command, *c);
  return {command, [c] { return run_case(*c); }};
}

}  // namespace hexwall
