#pragma once

#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "surface/prepare.h"
#include "surface/read.h"

namespace hexwall {

/// The options of every command that takes a surface as it comes.
struct InputOptions {
  std::string surface;
  std::string units = "mm";
  std::vector<std::string> repair;  ///< steps; empty: all
  bool no_repair = false;
  std::optional<double> tolerance;
  std::optional<double> pinholes;
  std::string remesh = "auto";
  std::string open = "auto";
  std::string cap_array;
  std::string open_at;
  std::string names;
  double extend = 0.0;
};

void add_input_options(CLI::App& command, InputOptions& options);

/// What they mean, files read. \throws UsageError, ReadError.
PrepareOptions prepare_options(const InputOptions& options);

/// A scalar point array of the input at the vertices of the surface that it was prepared to.
/// \throws UsageError, naming the arrays there are, if there is none of that name.
std::vector<double> point_values(const ReadResult& read, const std::string& array,
                                 const TriangleSurface& prepared);

/// Metres in one unit of the input.
double metres_per_unit(const std::string& units);

}  // namespace hexwall
