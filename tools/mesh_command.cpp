#include "mesh_command.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "exporters/formats.h"
#include "exporters/output_file.h"
#include "exporters/results.h"
#include "output_folder.h"

namespace hexwall {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> format_names() {
  std::vector<std::string> names;
  for (const Format& format : hex_mesh_formats()) names.push_back(format.name);
  return names;
}

bool writes(const MeshOptions& c, const std::string& format) {
  return std::find(c.write.begin(), c.write.end(), format) != c.write.end();
}

void write_results(const MeshOptions& c, const PipelineResult& result, const fs::path& folder) {
  write_vtp(folder / "surface.vtp", surface_data(result));
  write_vtp(folder / "critical.vtp", critical_data(result));
  write_vtp(folder / "quads.vtp", quad_data(result));
  if (c.write_basis) write_vtp(folder / "basis.vtp", basis_data(result));
  for (const Format& format : hex_mesh_formats()) {
    if (!writes(c, format.name)) continue;
    format.write(folder / format.output, result, metres_per_unit(c.surface.input.units));
  }
}

ExitCode run_mesh(const MeshOptions& c) {
  spdlog::logger log = make_logger(c.surface);
  const auto limit = limit_threads(c.surface);
  OutputFolder folder(c.surface.output);
  SurfaceRun run = run_surface(c.surface);
  write_mesh_results(c, run, folder.staging());
  folder.commit();
  log_notes(log, run.prepared);
  log.info("{}  {:<10} {}", summary(run.result, c.surface.input.units), "results",
           folder.path().string());
  log_times(log, run);
  return ExitCode::success;
}

}  // namespace

void add_mesh_options(CLI::App& mesh, MeshOptions& c) {
  add_surface_options(mesh, c.surface);
  add_layer_options(mesh, c.surface.layers);
  mesh.add_option("--write", c.write, "Hex mesh formats, separated by commas")
      ->delimiter(',')
      ->check(CLI::IsMember(format_names()))
      ->capture_default_str();
  mesh.add_flag("--write-basis", c.write_basis,
                "Also write basis.vtp: every basis form as texture coordinates");
}

void write_mesh_results(const MeshOptions& c, SurfaceRun& run, const fs::path& folder) {
  run.context.io_times.push_back({"write", timed([&] { write_results(c, run.result, folder); })});
  run.context.prepared = &run.prepared;
  write_output_file(folder / "report.json", make_report(run.result, run.context).dump(2) + "\n");
}

Command add_mesh(CLI::App& app) {
  CLI::App* mesh = app.add_subcommand("mesh", "Mesh the wall of a vessel with hexahedra");
  const auto c = std::make_shared<MeshOptions>();
  add_mesh_options(*mesh, *c);
  return {mesh, [c] { return run_mesh(*c); }};
}

}  // namespace hexwall
