#pragma once

#include <ostream>
#include <string>
#include <vector>

namespace hexwall::test {

/// What a mesh is counted by.
struct MeshCounts {
  int openings = 0;
  int poles = 0;
  double order = 0.0;  ///< of all zeros together
  int half_zeros = 0;  ///< on boundary loops
  int irregular = 0;   ///< vertices of the quads, inside, of valence other than 4
  bool operator==(const MeshCounts&) const = default;
};

std::ostream& operator<<(std::ostream& out, const MeshCounts& counts);

/// What the program has to make of a surface: a row of tests/cases/outcomes.md, which says what its
/// columns mean.
struct Outcome {
  std::string surface;  ///< a name for `surface_file`
  int vertices = 0, triangles = 0;
  std::string untouched;             ///< words of the refusal by `check_surface`, or "ok"
  std::vector<std::string> options;  ///< of `hexwall mesh`
  int exit_code = 0;
  MeshCounts counts;       ///< if the exit code is 0
  std::string check_mesh;  ///< "ok", or words of what checkMesh finds; if the exit code is 0
  std::string words;       ///< of the refusal, or of what the program says it did

  bool is_clean() const { return untouched == "ok"; }
  /// A file of `shared_data`, rather than a shape or a file of the system.
  bool is_shared() const { return surface.find('.') != std::string::npos; }
};

void PrintTo(const Outcome& outcome, std::ostream* out);

/// All rows. \throws std::runtime_error, naming the row, if the table is not of its form.
const std::vector<Outcome>& outcomes();

/// One row for each file of `shared_data`: the first.
std::vector<Outcome> shared_files();

/// The first row of a surface. \throws std::runtime_error if there is none.
const Outcome& outcome_of(const std::string& surface);

}  // namespace hexwall::test
