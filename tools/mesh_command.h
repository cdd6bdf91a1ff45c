#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "command.h"
#include "progress_display.h"
#include "surface_command.h"

namespace hexwall {

/// The options of `hexwall mesh`.
struct MeshOptions {
  SurfaceCommandOptions surface;
  std::vector<std::string> write{"vtu", "openfoam"};
  bool write_basis = false;
  bool no_report = false;
  bool pictures = false;
};

void add_mesh_options(CLI::App& mesh, MeshOptions& options);

/// Writes all result files into a folder, the reports last, and shows how far that is.
/// \return why pictures that were asked for could not be taken; empty if they were.
/// \throws WriteError
std::string write_mesh_results(const MeshOptions& options, SurfaceRun& run,
                               const std::filesystem::path& folder, ProgressDisplay& progress);

/// `hexwall mesh`: from a vessel surface to the hexahedra of its wall, with a report.
Command add_mesh(CLI::App& app);

}  // namespace hexwall
