#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>
#include <spdlog/logger.h>
#include <tbb/global_control.h>

#include "input_options.h"
#include "layer_options.h"
#include "pipeline.h"
#include "report.h"

namespace hexwall {

class ProgressDisplay;

/// The options of every command that meshes a surface.
struct SurfaceCommandOptions {
  InputOptions input;
  std::string output;
  LayerCommandOptions layers;
  std::optional<double> size;
  double stretch = PipelineOptions{}.stretch;
  double relax = PipelineOptions{}.relax;
  std::string size_field;
  std::string poles = "auto";
  std::string size_by = "constant";
  int threads = 0;
  bool quiet = false;
  bool verbose = false;
};

/// All but those of the layers, which `add_layer_options` adds.
void add_surface_options(CLI::App& command, SurfaceCommandOptions& options);

/// Holds `--threads` as long as it lives; null without it.
std::unique_ptr<tbb::global_control> limit_threads(const SurfaceCommandOptions& options);

/// A surface that was read, prepared and meshed.
struct SurfaceRun {
  ReadResult read;
  PrepareResult prepared;
  PipelineResult result;
  ReportContext context;  ///< without `prepared`
};

/// Reads, prepares and meshes the surface, and shows how far that is. `adjust` may change the
/// options of the pipeline. \param shown where it is shown, if more than this is. \throws Error
SurfaceRun run_surface(const SurfaceCommandOptions& options,
                       const std::function<void(PipelineOptions&)>& adjust = {},
                       ProgressDisplay* shown = nullptr);

/// The same for a surface that was read already. Shows nothing; `progress` may.
SurfaceRun mesh_surface(const SurfaceCommandOptions& options, const PrepareOptions& preparation,
                        ReadResult read, const std::function<void(PipelineOptions&)>& adjust = {},
                        const ProgressCallback& progress = {});

/// Where a command says what it did: nothing but errors with `--quiet`, times with `--verbose`.
spdlog::logger make_logger(const SurfaceCommandOptions& options);

/// Says what was noted while the surface was prepared.
void log_notes(spdlog::logger& log, const PrepareResult& prepared);

/// Says how long each stage took, with `--verbose`.
void log_times(spdlog::logger& log, const SurfaceRun& run);

/// Seconds that `work` takes.
double timed(const std::function<void()>& work);

}  // namespace hexwall
