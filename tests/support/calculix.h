#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <string>

#include "surface/triangle_surface.h"

namespace hexwall::test {

/// Mean over the integration points of an element.
struct ElementMean {
  Vec3 position = Vec3::Zero();
  std::array<double, 6> stress{};  ///< xx, yy, zz, xy, xz, yz
};

/// What CalculiX computed, as far as the deck has it printed. Nodes and elements count from 1.
struct CalculixResult {
  bool available = false;  ///< ccx is installed and started
  bool ok = false;         ///< it ended without an error
  std::string log;
  std::map<int, Vec3> displacement;  ///< of *NODE PRINT, U
  std::map<int, ElementMean> means;  ///< of *EL PRINT, COORD and *EL PRINT, S
  Vec3 total_force = Vec3::Zero();   ///< of the last *NODE PRINT, RF with TOTALS=ONLY
};

/// Writes `deck` to `folder`/job.inp, runs `ccx` on it there and reads what it printed.
CalculixResult run_calculix(const std::filesystem::path& folder, const std::string& deck);

}  // namespace hexwall::test
