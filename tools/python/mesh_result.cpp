#include "mesh_result.h"

#include <algorithm>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <utility>
#include <variant>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/errors.h"
#include "exporters/formats.h"
#include "exporters/results.h"
#include "hex/cell_faces.h"
#include "output_folder.h"

namespace hexwall::python {
namespace {

namespace py = pybind11;

// Numbers of `owner` as an array that keeps it alive and cannot be written to; `components` per
// row, 0 for an array without columns.
template <class T>
py::array view(const T* data, std::size_t rows, std::size_t components, const py::handle& owner) {
  std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(rows)};
  if (components > 0) shape.push_back(static_cast<py::ssize_t>(components));
  py::array_t<T> array(shape, data, owner);
  array.attr("flags").attr("writeable") = false;
  return array;
}

py::array points_view(const std::vector<Vec3>& points, const py::handle& owner) {
  return view(points.empty() ? nullptr : points[0].data(), points.size(), 3, owner);
}

template <class T>
py::array view(const std::vector<T>& values, const py::handle& owner) {
  return view(values.data(), values.size(), 0, owner);
}

template <std::size_t N>
py::array view(const std::vector<std::array<int, N>>& rows, const py::handle& owner) {
  return view(rows.empty() ? nullptr : rows[0].data(), rows.size(), N, owner);
}

py::array hexes_view(const HexMesh& mesh, const py::handle& owner) {
  return view(mesh.connectivity.data(), mesh.shape.size(), 8, owner);
}

// A new array, of which Python is the owner.
py::array rows_array(const std::vector<int>& values, std::size_t rows, std::size_t columns) {
  py::array_t<int> array({static_cast<py::ssize_t>(rows), static_cast<py::ssize_t>(columns)});
  std::copy(values.begin(), values.end(), array.mutable_data());
  return array;
}

py::dict dict_of(const std::vector<DataArray>& arrays, const py::handle& owner) {
  py::dict dict;
  for (const DataArray& array : arrays) {
    const auto components =
        array.components > 1 ? static_cast<std::size_t>(array.components) : std::size_t{0};
    dict[array.name.c_str()] = std::visit(
        [&](const auto& values) -> py::array {
          const std::size_t rows = values.size() / std::max<std::size_t>(components, 1);
          return view(values.data(), rows, components, owner);
        },
        array.values);
  }
  return dict;
}

std::vector<std::string> names_of(const std::vector<CellGroup>& zones) {
  std::vector<std::string> names;
  for (const CellGroup& zone : zones) names.push_back(zone.name);
  return names;
}

py::dict patch_faces(const CellMesh& mesh) {
  py::dict dict;
  for (const CellPatch& patch : mesh.patches) {
    std::vector<int> values;
    for (const CellFace& face : patch.faces) {
      values.insert(values.end(), face.vertices.begin(), face.vertices.end());
    }
    dict[patch.name.c_str()] = rows_array(values, patch.faces.size(), 4);
  }
  return dict;
}

std::vector<std::string> patch_names(const CellMesh& mesh) {
  std::vector<std::string> names;
  for (const CellPatch& patch : mesh.patches) names.push_back(patch.name);
  return names;
}

py::array quads_array(const PolyData& quads) {
  return rows_array(quads.polygons.connectivity(), quads.polygons.size(), 4);
}

// A property computed from the Python object itself, which its arrays keep alive.
template <class Getter>
auto with_owner(Getter getter) {
  return [getter](const py::object& self) { return getter(self.cast<const MeshResult&>(), self); };
}

void check_formats(const std::vector<std::string>& names) {
  std::string known;
  for (const Format& format : hex_mesh_formats()) known += " " + format.name;
  for (const std::string& name : names) {
    const auto& all = hex_mesh_formats();
    if (std::any_of(all.begin(), all.end(), [&](const Format& f) { return f.name == name; })) {
      continue;
    }
    throw UsageError(fmt::format("unknown format '{}'; known are{}", name, known));
  }
}

}  // namespace

MeshResult::MeshResult(MeshOptions options, SurfaceRun run)
    : options_(std::move(options)),
      run_(std::move(run)),
      cell_arrays_(wall_cell_arrays(run_.result)),
      point_arrays_(wall_point_arrays(run_.result)),
      quads_(quad_data(run_.result)) {
  run_.context.prepared = &run_.prepared;
  cell_arrays_.push_back({"zone", 1, group_of_cells(wall(), wall().zones)});
  cell_arrays_.push_back({"region", 1, group_of_cells(wall(), wall().regions)});
  std::vector<int> patches;
  for (const auto& of_hex : patch_of_faces(wall())) {
    patches.insert(patches.end(), of_hex.begin(), of_hex.end());
  }
  cell_arrays_.push_back({"patch_of_face", 6, std::move(patches)});
}

std::string MeshResult::report() const {
  ReportContext context = run_.context;
  context.prepared = &run_.prepared;
  return make_report(run_.result, context).dump();
}

void MeshResult::write(const std::string& path, const std::vector<std::string>& formats,
                       bool write_basis) {
  check_formats(formats);
  MeshOptions options = options_;
  options.write = formats;
  options.write_basis = write_basis;
  OutputFolder folder(path);
  ProgressDisplay silent(false);
  write_mesh_results(options, run_, folder.staging(), silent);
  folder.commit();
}

py::object from_json(const std::string& json) {
  return py::module_::import("json").attr("loads")(json);
}

void bind_mesh_result(py::module_& module) {
  using R = MeshResult;
  using Self = const py::object&;
  py::class_<R, std::shared_ptr<R>>(module, "MeshResult")
      .def_property_readonly(
          "points", with_owner([](const R& r, Self s) { return points_view(r.wall().points, s); }))
      .def_property_readonly("hexes",
                             with_owner([](const R& r, Self s) { return hexes_view(r.wall(), s); }))
      .def_property_readonly(
          "cell_data", with_owner([](const R& r, Self s) { return dict_of(r.cell_arrays(), s); }))
      .def_property_readonly(
          "point_data", with_owner([](const R& r, Self s) { return dict_of(r.point_arrays(), s); }))
      .def_property_readonly("patches", [](const R& r) { return patch_faces(r.wall()); })
      .def_property_readonly("patch_names", [](const R& r) { return patch_names(r.wall()); })
      .def_property_readonly("zone_names", [](const R& r) { return names_of(r.wall().zones); })
      .def_property_readonly("region_names", [](const R& r) { return names_of(r.wall().regions); })
      .def_property_readonly("quad_points", with_owner([](const R& r, Self s) {
                               return points_view(r.quads().points, s);
                             }))
      .def_property_readonly("quads", [](const R& r) { return quads_array(r.quads()); })
      .def_property_readonly("quad_cell_data", with_owner([](const R& r, Self s) {
                               return dict_of(r.quads().cell_arrays, s);
                             }))
      .def_property_readonly("quad_point_data", with_owner([](const R& r, Self s) {
                               return dict_of(r.quads().point_arrays, s);
                             }))
      .def_property_readonly("surface_points", with_owner([](const R& r, Self s) {
                               return points_view(r.run().prepared.surface.points, s);
                             }))
      .def_property_readonly("surface_triangles", with_owner([](const R& r, Self s) {
                               return view(r.run().prepared.surface.triangles, s);
                             }))
      .def_property_readonly("report", [](const R& r) { return from_json(r.report()); })
      .def_property_readonly("warnings", [](const R& r) { return r.run().result.warnings; })
      .def_property_readonly("formats", [](const R& r) { return r.options().write; })
      .def_property_readonly("basis", [](const R& r) { return r.options().write_basis; })
      .def("_write", &R::write, py::call_guard<py::gil_scoped_release>())
      .def("__str__",
           [](const R& r) { return summary(r.run().result, r.options().surface.input.units); });
}

}  // namespace hexwall::python
