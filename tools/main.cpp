// The program. Sample runs:
//
//   hexwall mesh aneurysm.stl -o out --size 0.8 --thickness 0.5 --layers 3
//   hexwall check carotid.vtp
//   hexwall generate aaa -o aaa.stl
//
// `mesh` reads a vessel surface, runs the pipeline and writes the quad mesh, the hexahedral wall,
// an OpenFOAM case and a report. `check` says what is wrong with a surface. `generate` makes
// surfaces to try it on.

#include <charconv>
#include <chrono>
#include <exception>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <tbb/global_control.h>

#include "check_command.h"
#include "core/errors.h"
#include "exporters/formats.h"
#include "exporters/output_file.h"
#include "exporters/results.h"
#include "input_options.h"
#include "layer_options.h"
#include "output_folder.h"
#include "pipeline.h"
#include "progress_display.h"
#include "quality_command.h"
#include "report.h"
#include "surface/generate.h"
#include "surface/read.h"
#include "surface/read_points.h"
#include "surface/write.h"

namespace hexwall {
namespace {

namespace fs = std::filesystem;

struct MeshCommand {
  InputOptions input;
  std::string output;
  PipelineOptions pipeline;
  LayerCommandOptions layers;
  std::string size_field;
  std::string poles = "auto";
  std::string size_by = "constant";
  std::vector<std::string> write{"vtu", "openfoam"};
  bool write_basis = false;
  int threads = 0;
  bool quiet = false;
  bool verbose = false;
};

struct GenerateCommand {
  std::string shape;
  std::string output;
  std::optional<double> edge;
};

std::vector<std::string> format_names() {
  std::vector<std::string> names;
  for (const Format& format : hex_mesh_formats()) names.push_back(format.name);
  return names;
}

CLI::App* add_mesh(CLI::App& app, MeshCommand& c) {
  CLI::App* mesh = app.add_subcommand("mesh", "Mesh the wall of a vessel with hexahedra");
  add_input_options(*mesh, c.input);
  mesh->add_option("-o,--output", c.output, "Folder for the results")->required();
  mesh->add_option("--size", c.pipeline.size,
                   "Target quad edge length, in input units [sqrt(area / 20000)]");
  add_layer_options(*mesh, c.layers);
  mesh->add_option("--relax", c.pipeline.relax, "Quad sizes: 0 conformal … 1 even")
      ->capture_default_str();
  mesh->add_option("--poles", c.poles,
                   "Extra singularities in blind sacs: auto, off, a number, or a file with a point "
                   "x y z on each line")
      ->capture_default_str();
  mesh->add_option("--size-by", c.size_by, "Target edges: constant, or proportional to the radius")
      ->check(CLI::IsMember({"constant", "radius"}))
      ->capture_default_str();
  mesh->add_option("--size-field", c.size_field,
                   "Point array of the input: factors on the target edge length");
  mesh->add_option("--write", c.write, "Hex mesh formats, separated by commas")
      ->delimiter(',')
      ->check(CLI::IsMember(format_names()))
      ->capture_default_str();
  mesh->add_flag("--write-basis", c.write_basis,
                 "Also write basis.vtp: every basis form as texture coordinates");
  mesh->add_option("--threads", c.threads, "Threads; results do not depend on it [all cores]")
      ->check(CLI::Range(1, 1024));
  auto* quiet = mesh->add_flag("-q,--quiet", c.quiet, "Print errors only");
  mesh->add_flag("-v,--verbose", c.verbose, "Print the time of each stage")->excludes(quiet);
  return mesh;
}

CLI::App* add_generate(CLI::App& app, GenerateCommand& c) {
  CLI::App* generate = app.add_subcommand("generate", "Make a surface to try hexwall on");
  generate->add_option("SHAPE", c.shape, "annulus, eccentric-annulus, cylinder, bifurcation or aaa")
      ->required();
  generate->add_option("-o,--output", c.output, "File: .stl, .obj, .ply, .off, .vtp or .vtk")
      ->required();
  generate->add_option("--edge", c.edge, "Edge length of the triangles [by shape]");
  return generate;
}

// Seconds that `work` takes.
double timed(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

bool writes(const MeshCommand& c, const std::string& format) {
  return std::find(c.write.begin(), c.write.end(), format) != c.write.end();
}

void write_results(const MeshCommand& c, const PipelineResult& result, const fs::path& folder) {
  write_vtp(folder / "surface.vtp", surface_data(result));
  write_vtp(folder / "critical.vtp", critical_data(result));
  write_vtp(folder / "quads.vtp", quad_data(result));
  if (c.write_basis) write_vtp(folder / "basis.vtp", basis_data(result));
  for (const Format& format : hex_mesh_formats()) {
    if (!writes(c, format.name)) continue;
    format.write(folder / format.output, result, metres_per_unit(c.input.units));
  }
}

PoleRequest pole_request(const std::string& text) {
  PoleRequest request;
  int count = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (text == "auto") {
    request.mode = PoleRequest::Mode::automatic;
  } else if (text == "off") {
    request.mode = PoleRequest::Mode::off;
  } else if (error == std::errc() && end == text.data() + text.size()) {
    request.mode = PoleRequest::Mode::count;
    request.count = count;
  } else {
    if (!fs::exists(text)) {
      throw UsageError(fmt::format(
          "--poles is auto, off, a number or a file of points: there is no file '{}'", text));
    }
    request.mode = PoleRequest::Mode::places;
    request.places = read_points(text);
  }
  return request;
}

void run_mesh(const MeshCommand& c, spdlog::logger& log) {
  std::optional<tbb::global_control> limit;
  if (c.threads > 0) {
    limit.emplace(tbb::global_control::max_allowed_parallelism,
                  static_cast<std::size_t>(c.threads));
  }
  OutputFolder folder(c.output);
  ProgressDisplay progress(!c.quiet);
  const PrepareOptions preparation = prepare_options(c.input);
  PipelineOptions options = c.pipeline;
  options.poles = pole_request(c.poles);
  options.size_by_radius = c.size_by == "radius";
  ReportContext context{c.input.surface, c.input.units, 0, 0, nullptr, {}};
  ReadResult read;
  PrepareResult prepared;
  context.io_times.push_back({"read", timed([&] { read = read_surface(c.input.surface); })});
  context.vertices = static_cast<int>(read.surface.points.size());
  context.faces = static_cast<int>(read.surface.triangles.size());
  context.io_times.push_back(
      {"prepare", timed([&] { prepared = prepare_surface(read, preparation); })});
  context.prepared = &prepared;
  if (!c.size_field.empty()) {
    options.size_field = point_values(read, c.size_field, prepared.surface);
  }
  set_layer_options(c.layers, read, prepared.surface, options);
  const PipelineResult result = run_pipeline(
      prepared, options,
      [&](const std::string& stage, int index, int count) { progress.show(stage, index, count); });
  context.io_times.push_back({"write", timed([&] { write_results(c, result, folder.staging()); })});
  write_output_file(folder.staging() / "report.json", make_report(result, context).dump(2) + "\n");
  folder.commit();
  progress.finish();
  for (const std::string& note : prepared.notes) log.info("  {:<10} {}", "note", note);
  log.info("{}  {:<10} {}", summary(result, c.input.units), "results", folder.path().string());
  for (const std::vector<StageTime>* times : {&std::as_const(context).io_times, &result.times}) {
    for (const StageTime& time : *times) log.debug("  {:<10} {:.3f} s", time.stage, time.seconds);
  }
}

void run_generate(const GenerateCommand& c) {
  const TriangleSurface surface = generate_shape(shape_from_name(c.shape), c.edge);
  write_surface(c.output, surface);
  fmt::print("{}: {} vertices, {} triangles\n", c.output, surface.points.size(),
             surface.triangles.size());
}

int fail(ExitCode code, const std::string& message) {
  fmt::print(stderr, "hexwall: error: {}\n", message);
  return static_cast<int>(code);
}

int run(int argc, char** argv) {
  CLI::App app{"hexwall: hexahedral wall meshes of blood vessels"};
  app.set_version_flag("--version", "hexwall " + version());
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 success, 1 internal error, 2 command line, 3 unreadable input,\n"
      "4 topology of the surface, 5 geometry of the surface, 6 no valid mesh, 7 output,\n"
      "8 a condition of 'quality --fail-if' holds.");
  MeshCommand mesh;
  GenerateCommand generate;
  CheckCommand check;
  QualityCommand quality;
  const CLI::App* mesh_app = add_mesh(app, mesh);
  const CLI::App* check_app = add_check(app, check);
  const CLI::App* quality_app = add_quality(app, quality);
  add_generate(app, generate);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(ExitCode::usage);
  }
  spdlog::logger log("hexwall", std::make_shared<spdlog::sinks::stdout_sink_st>());
  log.set_pattern("%v");
  log.set_level(mesh.quiet ? spdlog::level::err
                           : (mesh.verbose ? spdlog::level::debug : spdlog::level::info));
  try {
    if (mesh_app->parsed()) {
      run_mesh(mesh, log);
    } else if (check_app->parsed()) {
      return static_cast<int>(run_check(check));
    } else if (quality_app->parsed()) {
      return run_quality(quality);
    } else {
      run_generate(generate);
    }
  } catch (const Error& error) {
    return fail(error.code(), error.what());
  } catch (const std::bad_alloc&) {
    return fail(ExitCode::internal, "out of memory: choose a larger --size");
  } catch (const std::exception& error) {
    return fail(ExitCode::internal,
                fmt::format("{}. This is a bug in hexwall: please report it", error.what()));
  }
  return static_cast<int>(ExitCode::success);
}

}  // namespace
}  // namespace hexwall

int main(int argc, char** argv) {
  return hexwall::run(argc, argv);
}
