#include "surface_command.h"

#include <charconv>
#include <chrono>
#include <filesystem>
#include <utility>

#include <fmt/format.h>
#include <spdlog/sinks/stdout_sinks.h>

#include "core/errors.h"
#include "progress_display.h"
#include "surface/read.h"
#include "surface/read_points.h"

namespace hexwall {
namespace {

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
    if (!std::filesystem::exists(text)) {
      throw UsageError(fmt::format(
          "--poles is auto, off, a number or a file of points: there is no file '{}'", text));
    }
    request.mode = PoleRequest::Mode::places;
    request.places = read_points(text);
  }
  return request;
}

// Options of the pipeline, files read.
PipelineOptions pipeline_options(const SurfaceCommandOptions& c, const ReadResult& read,
                                 const TriangleSurface& prepared) {
  PipelineOptions options;
  options.size = c.size;
  options.relax = c.relax;
  options.stretch = c.stretch;
  options.poles = pole_request(c.poles);
  options.size_by_radius = c.size_by == "radius";
  if (!c.size_field.empty()) options.size_field = point_values(read, c.size_field, prepared);
  set_layer_options(c.layers, read, prepared, options);
  return options;
}

}  // namespace

void add_surface_options(CLI::App& command, SurfaceCommandOptions& c) {
  add_input_options(command, c.input);
  command.add_option("-o,--output", c.output, "Folder for the results")->required();
  command.add_option(
      "--size", c.size,
      "Target quad edge length, in input units [sqrt(area / 20000), less for narrow openings]");
  command
      .add_option("--stretch", c.stretch,
                  "Length of the quads along the vessel over their width around it")
      ->capture_default_str();
  command.add_option("--relax", c.relax, "Quad sizes: 0 conformal … 1 even")->capture_default_str();
  command
      .add_option("--poles", c.poles,
                  "Extra singularities in blind sacs: auto, off, a number, or a file with a point "
                  "x y z on each line")
      ->capture_default_str();
  command
      .add_option("--size-by", c.size_by, "Target edges: constant, or proportional to the radius")
      ->check(CLI::IsMember({"constant", "radius"}))
      ->capture_default_str();
  command.add_option("--size-field", c.size_field,
                     "Point array of the input: factors on the target edge length");
  command.add_option("--threads", c.threads, "Threads; results do not depend on it [all cores]")
      ->check(CLI::Range(1, 1024));
  auto* quiet = command.add_flag("-q,--quiet", c.quiet, "Print errors only");
  command.add_flag("-v,--verbose", c.verbose, "Print the time of each stage")->excludes(quiet);
}

std::unique_ptr<tbb::global_control> limit_threads(const SurfaceCommandOptions& c) {
  if (c.threads <= 0) return nullptr;
  return std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                               static_cast<std::size_t>(c.threads));
}

SurfaceRun run_surface(const SurfaceCommandOptions& c,
                       const std::function<void(PipelineOptions&)>& adjust,
                       ProgressDisplay* shown) {
  std::optional<ProgressDisplay> own;
  ProgressDisplay& progress = shown != nullptr ? *shown : own.emplace(!c.quiet);
  const PrepareOptions preparation = prepare_options(c.input);
  ReadResult read;
  progress.begin("read");
  const double seconds = timed([&] { read = read_surface(c.input.surface); });
  progress.begin("prepare");
  SurfaceRun run = mesh_surface(c, preparation, std::move(read), adjust,
                                [&](const std::string& stage, int, int) { progress.begin(stage); });
  run.context.io_times.insert(run.context.io_times.begin(), {"read", seconds});
  return run;
}

SurfaceRun mesh_surface(const SurfaceCommandOptions& c, const PrepareOptions& preparation,
                        ReadResult read, const std::function<void(PipelineOptions&)>& adjust,
                        const ProgressCallback& progress) {
  SurfaceRun run;
  run.read = std::move(read);
  run.context = {c.input.surface, c.input.units, 0, 0, nullptr, {}};
  run.context.vertices = static_cast<int>(run.read.surface.points.size());
  run.context.faces = static_cast<int>(run.read.surface.triangles.size());
  run.context.io_times.push_back(
      {"prepare", timed([&] { run.prepared = prepare_surface(run.read, preparation); })});
  PipelineOptions options = pipeline_options(c, run.read, run.prepared.surface);
  if (adjust) adjust(options);
  run.result = run_pipeline(run.prepared, options, progress);
  return run;
}

spdlog::logger make_logger(const SurfaceCommandOptions& c) {
  spdlog::logger log("hexwall", std::make_shared<spdlog::sinks::stdout_sink_st>());
  log.set_pattern("%v");
  log.set_level(c.quiet ? spdlog::level::err
                        : (c.verbose ? spdlog::level::debug : spdlog::level::info));
  return log;
}

void log_notes(spdlog::logger& log, const PrepareResult& prepared) {
  for (const std::string& note : prepared.notes) log.info("  {:<10} {}", "note", note);
}

void log_times(spdlog::logger& log, const SurfaceRun& run) {
  for (const std::vector<StageTime>* times : {&run.context.io_times, &run.result.times}) {
    for (const StageTime& time : *times) log.debug("  {:<10} {:.3f} s", time.stage, time.seconds);
  }
}

double timed(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace hexwall
