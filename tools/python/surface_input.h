#pragma once

#include <pybind11/pybind11.h>
#include <string>

#include "surface/read.h"

namespace hexwall::python {

/// A surface from Python: the path of a file, or a pair (points, triangles) of arrays.
struct SurfaceInput {
  std::string name;  ///< the path; `memory` for arrays
  ReadResult read;
  double seconds = 0.0;  ///< that reading took
};

/// \param point_arrays, cell_arrays dicts of further arrays by name, or None.
/// \throws ReadError; TypeError or ValueError in Python where shapes are wrong.
SurfaceInput surface_input(const pybind11::object& surface, const pybind11::object& point_arrays,
                           const pybind11::object& cell_arrays);

}  // namespace hexwall::python
