#pragma once

#include <optional>
#include <string>
#include <vector>

#include "command.h"
#include "lumen/lumen.h"
#include "surface_command.h"

namespace hexwall {

/// The options of every command that meshes a lumen.
struct LumenCommandOptions {
  SurfaceCommandOptions surface;
  std::string mesh = "hybrid";
  std::optional<double> first_height;
  LumenOptions lumen;
};

/// Those of the surface and of the layers included.
void add_lumen_options(CLI::App& command, LumenCommandOptions& options);

/// A surface whose lumen was meshed.
struct LumenRun {
  SurfaceRun surface;
  LumenResult lumen;
};

/// Reads, prepares and meshes the surface and its lumen, and shows how far that is.
/// \throws UsageError for options that do not fit together; Error.
LumenRun run_lumen(const LumenCommandOptions& options);

/// `hexwall lumen`: the lumen of a vessel as a mesh for flow, with the wall if asked for.
Command add_lumen(CLI::App& app);

}  // namespace hexwall
