#pragma once

#include <filesystem>
#include <vector>

#include "exporters/vtk_files.h"
#include "pipeline.h"

namespace hexwall {

/// `surface.vtp`: the input's triangles (split where the Delaunay refinement split them) with y, x,
/// the texture coordinates `uv`, scale factor, cylinder and patch.
PolyData surface_data(const PipelineResult& result);

/// `critical.vtp`: zeros as points; horizontal and vertical critical trajectories as polylines.
PolyData critical_data(const PipelineResult& result);

/// `quads.vtp`: the quad mesh with cylinder, patch and scaled Jacobian of each quad, thickness of
/// the wall at each point.
PolyData quad_data(const PipelineResult& result);

/// `basis.vtp`: f_i, omega_i (integrated) and phi_i = (x_i, y_i) of every basis form.
PolyData basis_data(const PipelineResult& result);

/// Arrays on the hexes of `wall.vtu`: layer, quad, cylinder, extension, patch, scaled Jacobian.
std::vector<DataArray> wall_cell_arrays(const PipelineResult& result);

/// Arrays on its points: local radius, thickness asked and given.
std::vector<DataArray> wall_point_arrays(const PipelineResult& result);

/// Triangles with three points of their own, so that values may jump between triangles.
PolyData separate_triangles(const TriangleSurface& surface);

/// (x, y) of a form at the corners of all triangles, x integrated from triangle to triangle: it
/// jumps by periods only. 6 #F.
std::vector<double> form_at_corners(const FormSolution& solution, const HolomorphicForm& form);

/// `wall.vtu`: the hexes with `wall_cell_arrays` and `wall_point_arrays`.
void write_wall(const std::filesystem::path& path, const PipelineResult& result);

}  // namespace hexwall
