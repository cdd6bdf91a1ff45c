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

/// Runs `checkMesh` in `case_dir`. \param options of it; without any it leaves out determinants and
/// face tets.
CheckMeshResult check_mesh(const std::filesystem::path& case_dir,
                           const std::string& options = "-allGeometry -allTopology");

}  // namespace hexwall
