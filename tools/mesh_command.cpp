#include "mesh_command.h"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/parallel.h"
#include "exporters/formats.h"
#include "exporters/output_file.h"
#include "exporters/report_page.h"
#include "exporters/results.h"
#include "exporters/vtk_files.h"
#include "output_folder.h"
#include "pictures.h"
#include "view_script.h"

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

// Files are independent of each other: each is made and written by a task of its own, and one makes
// what the report's view shows.
void write_results(const MeshOptions& c, const PipelineResult& result, const fs::path& folder,
                   PageParts& parts) {
  std::vector<std::function<void()>> tasks;
  const double metres = metres_per_unit(c.surface.input.units);
  for (const Format& format : hex_mesh_formats()) {  // the largest ones first
    if (!writes(c, format.name)) continue;
    tasks.emplace_back([&, metres] { format.write(folder / format.output, result, metres); });
  }
  tasks.emplace_back([&] { write_vtp(folder / "surface.vtp", surface_data(result)); });
  tasks.emplace_back([&] { write_vtp(folder / "quads.vtp", quad_data(result)); });
  tasks.emplace_back([&] { write_vtp(folder / "critical.vtp", critical_data(result)); });
  if (c.write_basis) {
    tasks.emplace_back([&] { write_vtp(folder / "basis.vtp", basis_data(result)); });
  }
  if (!c.no_report) {
    tasks.emplace_back([&] { parts.distributions = distribution_plots(result); });
    if (!parts.view_script.empty()) {
      tasks.emplace_back([&] { parts.view = view_data(result); });
    }
  }
  parallel_tasks(tasks.size(), [&](std::size_t i) { tasks[i](); });
}

std::vector<ProgressStage> stages_of_writing(bool pictures) {
  std::vector<ProgressStage> stages{{"write", 0.12}};
  if (pictures) stages.push_back({"pictures", 1.0});
  return stages;
}

// Into the folder `pictures`, by way of a hidden one.
PictureResult write_pictures(const PipelineResult& result, const fs::path& folder,
                             ProgressDisplay& progress) {
  const fs::path meanwhile = folder / ".pictures";
  PictureResult taken = take_pictures(meanwhile, result, [&](int index, int count) {
    progress.detail(fmt::format("{} of {}", index + 1, count));
  });
  fs::remove_all(meanwhile);
  for (const PagePicture& picture : taken.pictures) {
    fs::create_directories(folder / "pictures");
    write_output_file(folder / "pictures" / (picture.name + ".png"), picture.png);
  }
  return taken;
}

ExitCode run_mesh(const MeshOptions& c) {
  spdlog::logger log = make_logger(c.surface);
  const auto limit = limit_threads(c.surface);
  OutputFolder folder(c.surface.output);
  ProgressDisplay progress(!c.surface.quiet, stages_of_writing(c.pictures));
  SurfaceRun run = run_surface(c.surface, {}, &progress);
  const std::string note = write_mesh_results(c, run, folder.staging(), progress);
  folder.commit();
  progress.finish();
  log_notes(log, run.prepared);
  log.info("{}  {:<10} {}", summary(run.result, c.surface.input.units), "results",
           folder.path().string());
  if (!note.empty()) log.warn("  {:<10} {}", "note", note);
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
  auto* no_report = mesh.add_flag("--no-report", c.no_report, "Don't write report.html");
  mesh.add_flag("--pictures", c.pictures,
                "Take pictures: PNG files in DIR/pictures, and in the report")
      ->excludes(no_report);
}

std::string write_mesh_results(const MeshOptions& c, SurfaceRun& run, const fs::path& folder,
                               ProgressDisplay& progress) {
  std::vector<StageTime>& times = run.context.io_times;
  progress.begin("write");
  PageParts parts;
  parts.view_script = view_script();
  times.push_back({"write", timed([&] { write_results(c, run.result, folder, parts); })});
  if (c.pictures) {
    progress.begin("pictures");
    PictureResult taken;
    times.push_back(
        {"pictures", timed([&] { taken = write_pictures(run.result, folder, progress); })});
    parts.pictures = std::move(taken.pictures);
    parts.pictures_note = std::move(taken.reason);
  }
  run.context.prepared = &run.prepared;
  const auto report = make_report(run.result, run.context);
  write_output_file(folder / "report.json", report.dump(2) + "\n");
  if (!c.no_report) {
    write_output_file(folder / "report.html", report_page(run.result, report, parts));
  }
  return parts.pictures_note;
}

Command add_mesh(CLI::App& app) {
  CLI::App* mesh = app.add_subcommand("mesh", "Mesh the wall of a vessel with hexahedra");
  const auto c = std::make_shared<MeshOptions>();
  add_mesh_options(*mesh, *c);
  return {mesh, [c] { return run_mesh(*c); }};
}

}  // namespace hexwall
