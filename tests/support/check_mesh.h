#pragma once

#include <filesystem>
#include <string>

namespace hexwall {

/// What OpenFOAM's own checker says of a case.
struct CheckMeshResult {
  bool available = false;  ///< checkMesh is installed and started
  bool ok = false;         ///< it ended with "Mesh OK."
  std::string log;
};

/// Runs `checkMesh -allGeometry -allTopology` in `case_dir`.
CheckMeshResult check_mesh(const std::filesystem::path& case_dir);

}  // namespace hexwall
