#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "command.h"
#include "surface_command.h"

namespace hexwall {

/// The options of `hexwall mesh`.
struct MeshOptions {
  SurfaceCommandOptions surface;
  std::vector<std::string> write{"vtu", "openfoam"};
  bool write_basis = false;
};

void add_mesh_options(CLI::App& mesh, MeshOptions& options);

/// Writes all result files into a folder, the report last. \throws WriteError
void write_mesh_results(const MeshOptions& options, SurfaceRun& run,
                        const std::filesystem::path& folder);

/// `hexwall mesh`: from a vessel surface to the hexahedra of its wall, with a report.
Command add_mesh(CLI::App& app);

}  // namespace hexwall
