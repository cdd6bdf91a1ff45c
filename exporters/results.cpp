#include "exporters/results.h"

#include <array>
#include <cmath>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "exporters/corner_values.h"
#include "foliation/labels.h"
#include "hex/quality.h"

namespace hexwall {
namespace {

// Kinds of cells in critical.vtp.
constexpr int kind_zero = 0;
constexpr int kind_horizontal = 1;
constexpr int kind_vertical = 2;

std::vector<double> at_corners(const TriangleSurface& surface, const Eigen::VectorXd& values) {
  std::vector<double> result;
  result.reserve(3 * surface.triangles.size());
  for (const auto& triangle : surface.triangles) {
    for (const int v : triangle) result.push_back(values[v]);
  }
  return result;
}

// A closed form integrated over each triangle, continued from triangle to triangle: its values at
// the corners jump by periods only.
std::vector<double> integrate(const Connectivity& mesh, const OneForm& form) {
  std::vector<double> x(mesh.halfedge_count(), 0.0);
  std::vector<bool> seen(mesh.face_count(), false);
  std::vector<int> queue{0};
  seen[0] = true;
  for (std::size_t i = 0; i < queue.size(); ++i) {
    const int f = queue[i];
    const auto set_from = [&](int h, double value) {
      for (int k = 0; k < 3; ++k, h = Connectivity::next(h)) {
        x[h] = value;
        value += form.along(mesh, h);
      }
    };
    if (i == 0) set_from(3 * f, 0.0);
    for (int h = 3 * f; h < 3 * f + 3; ++h) {
      const int twin = mesh.twin(h);
      if (twin < 0 || seen[Connectivity::face(twin)]) continue;
      seen[Connectivity::face(twin)] = true;
      set_from(twin, x[Connectivity::next(h)]);
      queue.push_back(Connectivity::face(twin));
    }
  }
  return x;
}

void add_polyline(PolyData& data, const std::vector<Vec3>& points) {
  std::vector<int> ids;
  ids.reserve(points.size());
  for (const Vec3& p : points) {
    ids.push_back(static_cast<int>(data.points.size()));
    data.points.push_back(p);
  }
  data.lines.add(ids);
}

// Thickness asked, given, and their ratio at each vertex of the quads, for each side.
std::vector<DataArray> thickness_arrays(const PipelineResult& r) {
  std::vector<DataArray> arrays{{"radius", 1, r.radius}};
  const auto add = [&](const std::optional<ThicknessResult>& side, const std::string& prefix) {
    if (!side) return;
    std::vector<double> ratio;
    for (int v = 0; v < static_cast<int>(side->given.size()); ++v) ratio.push_back(side->ratio(v));
    arrays.push_back({prefix + "thickness", 1, side->given});
    arrays.push_back({prefix + "thickness_asked", 1, side->asked});
    arrays.push_back({prefix + "thickness_ratio", 1, std::move(ratio)});
  };
  add(r.outward, "");
  add(r.inward, "inner_");
  return arrays;
}

// The same at each vertex of the hexes.
std::vector<DataArray> repeated_for_levels(std::vector<DataArray> arrays, std::size_t levels) {
  for (DataArray& array : arrays) {
    auto& values = std::get<std::vector<double>>(array.values);
    const std::vector<double> once = values;
    for (std::size_t i = 1; i < levels; ++i) values.insert(values.end(), once.begin(), once.end());
  }
  return arrays;
}

std::vector<double> interleaved(const std::vector<double>& x, const std::vector<double>& y) {
  std::vector<double> pairs;
  pairs.reserve(2 * x.size());
  for (std::size_t c = 0; c < x.size(); ++c) pairs.insert(pairs.end(), {x[c], y[c]});
  return pairs;
}

}  // namespace

PolyData separate_triangles(const TriangleSurface& surface) {
  PolyData data;
  data.points.reserve(3 * surface.triangles.size());
  data.polygons.reserve(surface.triangles.size(), 3);
  for (const auto& triangle : surface.triangles) {
    const int first = static_cast<int>(data.points.size());
    for (const int v : triangle) data.points.push_back(surface.points[v]);
    data.polygons.add(std::array{first, first + 1, first + 2});
  }
  return data;
}

std::vector<double> form_at_corners(const FormSolution& s, const HolomorphicForm& form) {
  return interleaved(integrate(s.connectivity, form.dx), at_corners(s.refined.surface, form.y));
}

PolyData surface_data(const PipelineResult& r) {
  const TriangleSurface& surface = r.solution.refined.surface;
  const SurfaceLabels labels = label_surface(r.solution.connectivity, r.solution.form, r.foliation,
                                             r.numbers.across, r.numbers.along, r.spacing);
  std::vector<double> x;
  std::vector<double> uv;
  for (std::size_t f = 0; f < surface.triangles.size(); ++f) {
    x.insert(x.end(), labels.x[f].begin(), labels.x[f].end());
    uv.insert(uv.end(), labels.uv[f].begin(), labels.uv[f].end());
  }
  PolyData data = with_corner_values(surface, {{"y", 1, at_corners(surface, r.solution.form.y)},
                                               {"x", 1, std::move(x)},
                                               {"uv", 2, std::move(uv)}});
  data.texture_coordinates = "uv";
  data.cell_arrays.push_back({"cylinder", 1, labels.cylinder});
  data.cell_arrays.push_back({"patch", 1, labels.patch});
  data.cell_arrays.push_back({"input_triangle", 1, r.solution.refined.parent_face});
  data.cell_arrays.push_back({"scale_factor", 1, r.solution.scale_factor});
  data.cell_arrays.push_back({"size_ratio", 1, r.solution.size_ratio});
  return data;
}

PolyData critical_data(const PipelineResult& r) {
  PolyData data;
  std::vector<int> kinds;
  std::vector<double> orders;
  for (const Zero& zero : r.foliation.graph.zeros) {
    data.vertices.add(std::array{static_cast<int>(data.points.size())});
    data.points.push_back(r.solution.refined.surface.points[zero.vertex]);
    kinds.push_back(kind_zero);
    orders.push_back(0.5 * zero.doubled_order);
  }
  for (const Arc& arc : r.foliation.graph.arcs) {
    std::vector<Vec3> points;
    points.reserve(arc.curve.points.size());
    for (const EdgePoint& p : arc.curve.points) {
      points.push_back(position(r.solution.refined.surface, r.solution.connectivity, p));
    }
    add_polyline(data, points);
    kinds.push_back(kind_horizontal);
    orders.push_back(0.0);
  }
  for (const std::vector<int>& line : r.conformal.vertical_lines) {
    std::vector<Vec3> points;
    points.reserve(line.size());
    for (const int v : line) points.push_back(r.conformal.mesh.points[v]);
    add_polyline(data, points);
    kinds.push_back(kind_vertical);
    orders.push_back(0.0);
  }
  data.cell_arrays.push_back({"kind", 1, std::move(kinds)});
  data.cell_arrays.push_back({"order", 1, std::move(orders)});
  data.strings.push_back({"kind_names", {"zero", "horizontal", "vertical"}});
  return data;
}

PolyData quad_data(const PipelineResult& r) {
  PolyData data;
  data.points = r.quads.points;
  data.polygons.reserve(r.quads.quads.size(), 4);
  for (const auto& quad : r.quads.quads) data.polygons.add(quad);
  data.point_arrays.push_back({"loop", 1, r.quads.loop_of_vertex});
  data.point_arrays.push_back({"target_edge", 1, r.target_edge});
  for (DataArray& array : thickness_arrays(r)) data.point_arrays.push_back(std::move(array));
  data.cell_arrays.push_back({"cylinder", 1, r.quads.cylinder});
  data.cell_arrays.push_back({"extension", 1, r.extension});
  data.cell_arrays.push_back({"patch", 1, r.quads.patch});
  data.cell_arrays.push_back({"scaled_jacobian", 1, r.quad_quality.scaled_jacobian});
  FieldStrings names{"loop_names", {}};
  for (const Opening& opening : r.openings) names.values.emplace_back(opening.name);
  data.strings.push_back(std::move(names));
  return data;
}

PolyData basis_data(const PipelineResult& r) {
  const TriangleSurface& surface = r.solution.refined.surface;
  const HolomorphicBasis& basis = r.solution.basis;
  const Eigen::MatrixXd g = potentials(basis);
  const PeriodicForms periodic =
      periodic_forms(r.solution.connectivity, *laplace_of(r.solution), basis);
  std::vector<DataArray> arrays;
  for (int i = 0; i < basis.size(); ++i) {
    const std::string loop = loop_name(r, basis.loop(i));
    std::vector<double> x = integrate(r.solution.connectivity, periodic.form(i));
    const std::vector<double> y = at_corners(surface, g.col(i));
    std::vector<double> phi = interleaved(x, y);
    arrays.push_back({"f_" + loop, 1, at_corners(surface, basis.f.col(i))});
    arrays.push_back({"omega_" + loop, 1, std::move(x)});
    arrays.push_back({"phi_" + loop, 2, std::move(phi)});
  }
  PolyData data = with_corner_values(surface, arrays);
  data.texture_coordinates = "phi_" + loop_name(r, basis.loop(0));
  return data;
}

std::vector<DataArray> wall_cell_arrays(const PipelineResult& r) {
  std::vector<int> cylinder;
  std::vector<int> patch;
  std::vector<int> extension;
  for (const int quad : r.wall.quad) {
    extension.push_back(r.extension[quad]);
    cylinder.push_back(r.quads.cylinder[quad]);
    patch.push_back(r.quads.patch[quad]);
  }
  std::vector<DataArray> arrays;
  arrays.push_back({"layer", 1, r.wall.layer});
  arrays.push_back({"quad", 1, r.wall.quad});
  arrays.push_back({"cylinder", 1, std::move(cylinder)});
  arrays.push_back({"extension", 1, std::move(extension)});
  arrays.push_back({"patch", 1, std::move(patch)});
  arrays.push_back({"scaled_jacobian", 1, r.wall_scaled_jacobian});
  return arrays;
}

std::vector<DataArray> wall_point_arrays(const PipelineResult& r) {
  return repeated_for_levels(thickness_arrays(r), r.layers.levels.size());
}

void write_wall(const std::filesystem::path& path, const PipelineResult& r) {
  write_vtu(path, r.wall, wall_cell_arrays(r), wall_point_arrays(r));
}

}  // namespace hexwall
