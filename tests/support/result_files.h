#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "support/mesh_verifier.h"
#include "support/outcomes.h"

/// Reads back what `hexwall mesh` wrote, with VTK and none of our code.
namespace hexwall::test {

struct HexFile {
  Points points;
  Hexes hexes;
  std::vector<std::string> patch_names;
  std::vector<Quads> patches;  ///< faces of each patch, counter-clockwise from outside
};

struct QuadFile {
  Points points;
  Quads quads;
};

/// Reads a `wall.vtu`. \throws std::runtime_error if it is none.
HexFile read_hex_file(const std::filesystem::path& path);

/// Reads a `quads.vtp`. \throws std::runtime_error if it is none.
QuadFile read_quad_file(const std::filesystem::path& path);

/// The report in a folder of results.
nlohmann::json report_in(const std::filesystem::path& folder);

/// The counts in a report.
MeshCounts counts_of(const nlohmann::json& report);

/// Expects that the meshes in a folder of results are valid and those of their report: hexes by
/// `verify_hexes`; quads by `verify_quads`, one piece, of genus 0, with the report's loops, poles
/// closed, and irregular vertices.
void expect_valid_results(const std::filesystem::path& folder);

}  // namespace hexwall::test
