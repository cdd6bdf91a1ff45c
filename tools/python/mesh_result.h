#pragma once

#include <memory>
#include <pybind11/pybind11.h>
#include <string>
#include <vector>

#include "exporters/vtk_files.h"
#include "mesh_command.h"

namespace hexwall::python {

/// What `hexwall.mesh` returns: the run, and the arrays that its files would hold.
class MeshResult {
 public:
  MeshResult(MeshOptions options, SurfaceRun run);

  const SurfaceRun& run() const { return run_; }
  const HexMesh& wall() const { return run_.result.wall; }
  const std::vector<DataArray>& cell_arrays() const { return cell_arrays_; }
  const std::vector<DataArray>& point_arrays() const { return point_arrays_; }
  const PolyData& quads() const { return quads_; }
  std::string report() const;

  /// The files of `hexwall mesh -o folder`. Nothing half-written stays behind. \throws WriteError
  void write(const std::string& folder, const std::vector<std::string>& formats, bool write_basis);
  const MeshOptions& options() const { return options_; }

 private:
  MeshOptions options_;
  SurfaceRun run_;
  std::vector<DataArray> cell_arrays_, point_arrays_;
  PolyData quads_;
};

/// Makes the class known to Python, its arrays as NumPy's.
void bind_mesh_result(pybind11::module_& module);

/// JSON as dicts and lists.
pybind11::object from_json(const std::string& json);

}  // namespace hexwall::python
