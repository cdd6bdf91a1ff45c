#pragma once

#include <stdexcept>
#include <string>

namespace hexwall {

/// Exit codes of the program; one exception class stands for each class of failure.
enum class ExitCode {
  success = 0,
  internal = 1,  ///< a bug in hexwall: please report it
  usage = 2,     ///< the command line is wrong
  read = 3,      ///< the input file is missing, truncated or of an unknown format
  topology = 4,  ///< the surface is no sphere with two or more holes, or not manifold
  geometry = 5,  ///< non-finite coordinates, triangles without area, self-intersections
  meshing = 6,   ///< the surface is valid, but no valid mesh was found
  write = 7      ///< an output file could not be written
};

/// Base of all failures. `what()` says what is wrong, where, and what the user can do.
class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

struct UsageError : Error {
  explicit UsageError(const std::string& m) : Error(ExitCode::usage, m) {}
};
struct ReadError : Error {
  explicit ReadError(const std::string& m) : Error(ExitCode::read, m) {}
};
struct TopologyError : Error {
  explicit TopologyError(const std::string& m) : Error(ExitCode::topology, m) {}
};
struct GeometryError : Error {
  explicit GeometryError(const std::string& m) : Error(ExitCode::geometry, m) {}
};
struct MeshingError : Error {
  explicit MeshingError(const std::string& m) : Error(ExitCode::meshing, m) {}
};
struct WriteError : Error {
  explicit WriteError(const std::string& m) : Error(ExitCode::write, m) {}
};

}  // namespace hexwall
