#include "lumen_command.h"

#include <algorithm>
#include <filesystem>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "exporters/gmsh.h"
#include "exporters/openfoam.h"
#include "exporters/output_file.h"
#include "exporters/vtk_files.h"
#include "lumen/lumen_report.h"
#include "output_folder.h"
#include "progress_display.h"

namespace hexwall {
namespace {

// Shares of the time, of that of the surface and its layers together.
const std::vector<ProgressStage> lumen_stages{
    {"caps", 0.1}, {"tetrahedra", 1.0}, {"improve", 2.0}, {"judge", 0.2}};

namespace fs = std::filesystem;

struct LumenCommand {
  LumenCommandOptions lumen;
  std::vector<std::string> write{"vtu", "openfoam"};
};

bool is_hybrid(const LumenCommandOptions& c) {
  return c.mesh == "hybrid";
}

void check_options(const LumenCommandOptions& c) {
  const std::string& side = c.surface.layers.side;
  if (side == "out") {
    throw UsageError(
        "--side out has no layers in the lumen: choose in or both, or hexwall mesh for the wall");
  }
  if (side == "both" && !is_hybrid(c)) {
    throw UsageError("--side both needs --mesh hybrid: tetrahedra don't conform to the wall");
  }
  if (c.first_height && !(*c.first_height > 0.0)) {
    throw UsageError("--first-height must be a positive length");
  }
  if (c.lumen.core_growth.value_or(0.0) < 0.0)
    throw UsageError("--core-growth must not be negative");
}

// The thickness of all layers from the height of the first.
void set_first_height(const LumenCommandOptions& c, PipelineOptions& options) {
  if (!c.first_height) return;
  LayerOptions& layers = *options.inward;
  if (layers.thickness || layers.thickness_ratio || !layers.thickness_field.empty() ||
      !layers.groups.empty()) {
    throw UsageError("--first-height goes with --layers and --growth, not with a thickness");
  }
  double thickness = 0.0;
  double height = *c.first_height;
  for (int i = 0; i < layers.layers; ++i, height *= layers.growth) thickness += height;
  layers.thickness = thickness;
}

void write_results(const LumenCommand& c, const LumenRun& run, const fs::path& folder) {
  const auto writes = [&](const std::string& format) {
    return std::find(c.write.begin(), c.write.end(), format) != c.write.end();
  };
  const CellMesh& mesh = run.lumen.mesh;
  const double metres = metres_per_unit(c.lumen.surface.input.units);
  if (writes("vtu")) write_vtu(folder / "lumen.vtu", mesh);
  if (writes("gmsh")) write_gmsh(folder / "lumen.msh", mesh);
  if (!writes("openfoam")) return;
  if (mesh.regions.size() > 1) {
    write_openfoam_regions(folder / "openfoam", mesh, metres);
  } else {
    write_openfoam(folder / "openfoam", mesh, metres);
  }
}

ExitCode run(const LumenCommand& c) {
  spdlog::logger log = make_logger(c.lumen.surface);
  const auto limit = limit_threads(c.lumen.surface);
  OutputFolder folder(c.lumen.surface.output);
  LumenRun run = run_lumen(c.lumen);
  SurfaceRun& surface = run.surface;
  surface.context.io_times.push_back(
      {"write", timed([&] { write_results(c, run, folder.staging()); })});
  surface.context.prepared = &surface.prepared;
  nlohmann::ordered_json report = make_report(surface.result, surface.context);
  report["lumen"] = lumen_json(run.lumen);
  write_output_file(folder.staging() / "report.json", report.dump(2) + "\n");
  folder.commit();
  const std::string& units = c.lumen.surface.input.units;
  log_notes(log, surface.prepared);
  log.info("{}{}{}  {:<10} {}", summary(surface.result, units), lumen_summary(run.lumen, units),
           openings_summary(run.lumen, units), "results", folder.path().string());
  log_times(log, surface);
  for (const StageTime& time : run.lumen.times) {
    log.debug("  {:<10} {:.3f} s", time.stage, time.seconds);
  }
  return ExitCode::success;
}

}  // namespace

void add_lumen_options(CLI::App& command, LumenCommandOptions& c) {
  c.surface.layers.side = "in";
  add_surface_options(command, c.surface);
  add_layer_options(command, c.surface.layers);
  const std::string group = "Lumen";
  command
      .add_option("--mesh", c.mesh,
                  "hybrid: layers of hexahedra, pyramids, and tetrahedra in the core; tet: "
                  "tetrahedra only")
      ->check(CLI::IsMember({"hybrid", "tet"}))
      ->capture_default_str()
      ->group(group);
  command
      .add_option("--first-height", c.first_height,
                  "Height of the layer at the wall, instead of a thickness, in input units")
      ->group(group);
  command
      .add_option(
          "--core-growth", c.lumen.core_growth,
          "Edges of tetrahedra grow by this share of the distance from the wall or its layers "
          "[hybrid: 0.2; tet: 0]")
      ->group(group);
  command
      .add_option("--inlet", c.lumen.inlet, "Name of the opening that is the inlet [the largest]")
      ->group(group);
}

LumenRun run_lumen(const LumenCommandOptions& c) {
  check_options(c);
  LumenRun run;
  ProgressDisplay progress(!c.surface.quiet, lumen_stages);
  run.surface = run_surface(
      c.surface,
      [&](PipelineOptions& o) {
        set_first_height(c, o);
        o.leaves_room_for_core = true;
      },
      &progress);
  LumenOptions options = c.lumen;
  options.mesh = is_hybrid(c) ? LumenOptions::Mesh::hybrid : LumenOptions::Mesh::tet;
  run.lumen = make_lumen(run.surface.result, options,
                         [&](const std::string& stage, int, int) { progress.begin(stage); });
  return run;
}

Command add_lumen(CLI::App& app) {
  CLI::App* lumen = app.add_subcommand(
      "lumen", "Mesh the lumen of a vessel for flow, and its wall with --side both");
  const auto c = std::make_shared<LumenCommand>();
  add_lumen_options(*lumen, c->lumen);
  lumen->add_option("--write", c->write, "Formats, separated by commas")
      ->delimiter(',')
      ->check(CLI::IsMember({"vtu", "openfoam", "gmsh"}))
      ->capture_default_str();
  return {lumen, [c] { return run(*c); }};
}

}  // namespace hexwall
