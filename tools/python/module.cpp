// The part of the Python package in C++. hexwall/__init__.py gives it its signatures.

#include <memory>
#include <optional>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "check_command.h"
#include "core/errors.h"
#include "errors.h"
#include "interrupts.h"
#include "keywords.h"
#include "mesh_command.h"
#include "mesh_result.h"
#include "report.h"
#include "surface/generate.h"
#include "surface/names.h"
#include "surface_input.h"

namespace hexwall::python {
namespace {

namespace py = pybind11;

// Stands where the command line needs a value that Python has already given otherwise.
constexpr const char* given = "given";

Vec3 place_of(const py::handle& value) {
  const auto numbers = value.cast<std::vector<double>>();
  if (numbers.size() != 3) throw py::value_error("a place is x, y, z");
  return {numbers[0], numbers[1], numbers[2]};
}

// Names of openings that are a dict, not a file; taken out of the keywords then.
std::vector<NamedPlace> take_names(py::dict& keywords) {
  std::vector<NamedPlace> names;
  if (!keywords.contains("names") || !py::isinstance<py::dict>(keywords["names"])) return names;
  for (const auto& [key, value] : keywords["names"].cast<py::dict>()) {
    const auto name = key.cast<std::string>();
    if (!is_valid_name(name)) {
      throw UsageError(
          fmt::format("'{}' cannot be the name of a patch: {}", name, valid_name_rule()));
    }
    names.push_back({name, place_of(value)});
  }
  keywords.attr("pop")("names");
  return names;
}

// Places of poles that are an array, not a file; taken out of the keywords then.
std::vector<Vec3> take_poles(py::dict& keywords) {
  std::vector<Vec3> places;
  if (!keywords.contains("poles")) return places;
  const py::object poles = keywords["poles"];
  if (!py::isinstance<py::sequence>(poles) && !py::isinstance<py::array>(poles)) return places;
  if (py::isinstance<py::str>(poles)) return places;
  for (const py::handle& row : poles) places.push_back(place_of(row));
  keywords.attr("pop")("poles");
  return places;
}

py::dict copy_of(const py::dict& keywords) {
  return keywords.attr("copy")().cast<py::dict>();
}

std::shared_ptr<MeshResult> mesh(const py::object& surface, const py::object& point_arrays,
                                 const py::object& cell_arrays, const py::object& progress,
                                 const py::object& cancelled, const py::dict& options) {
  py::dict keywords = copy_of(options);
  const std::vector<NamedPlace> names = take_names(keywords);
  const std::vector<Vec3> poles = take_poles(keywords);
  const py::object output = keywords.attr("pop")("output", py::none());
  CLI::App command;
  MeshOptions c;
  add_mesh_options(command, c);
  parse_keywords(command, keywords, {given, std::string("--output=") + given});
  SurfaceInput input = surface_input(surface, point_arrays, cell_arrays);
  c.surface.input.surface = input.name;
  PrepareOptions preparation = prepare_options(c.surface.input);
  if (!names.empty()) preparation.names = names;
  const auto limit = limit_threads(c.surface);
  std::shared_ptr<MeshResult> result;
  const ProgressCallback callback = progress_callback(progress);
  run_without_gil(cancelled, [&] {
    SurfaceRun run = mesh_surface(
        c.surface, preparation, std::move(input.read),
        [&](PipelineOptions& pipeline) {
          if (poles.empty()) return;
          pipeline.poles.mode = PoleRequest::Mode::places;
          pipeline.poles.places = poles;
        },
        callback);
    run.context.io_times.insert(run.context.io_times.begin(), {"read", input.seconds});
    result = std::make_shared<MeshResult>(c, std::move(run));
  });
  if (!output.is_none()) {
    const auto folder = py::module_::import("os").attr("fspath")(output).cast<std::string>();
    run_without_gil(cancelled, [&] { result->write(folder, c.write, c.write_basis); });
  }
  return result;
}

py::object check(const py::object& surface, const py::object& cell_arrays,
                 const py::object& cancelled, const py::dict& options) {
  py::dict keywords = copy_of(options);
  const std::vector<NamedPlace> names = take_names(keywords);
  CLI::App command;
  CheckOptions c;
  add_check_options(command, c);
  parse_keywords(command, keywords, {given});
  SurfaceInput input = surface_input(surface, py::none(), cell_arrays);
  c.input.surface = input.name;
  PrepareOptions preparation = prepare_options(c.input);
  if (!names.empty()) preparation.names = names;
  std::string json;
  run_without_gil(cancelled,
                  [&] { json = check_report(c, preparation, std::move(input.read)).dump(); });
  return from_json(json);
}

py::tuple generate(const std::string& shape, std::optional<double> edge) {
  TriangleSurface surface;
  run_without_gil(py::none(), [&] { surface = generate_shape(shape_from_name(shape), edge); });
  py::array_t<double> points({static_cast<py::ssize_t>(surface.points.size()), py::ssize_t{3}});
  py::array_t<int> triangles({static_cast<py::ssize_t>(surface.triangles.size()), py::ssize_t{3}});
  for (std::size_t v = 0; v < surface.points.size(); ++v) {
    for (int k = 0; k < 3; ++k) {
      points.mutable_at(static_cast<py::ssize_t>(v), k) = surface.points[v][k];
    }
  }
  for (std::size_t f = 0; f < surface.triangles.size(); ++f) {
    for (int k = 0; k < 3; ++k) {
      triangles.mutable_at(static_cast<py::ssize_t>(f), k) = surface.triangles[f][k];
    }
  }
  return py::make_tuple(points, triangles);
}

py::list mesh_options() {
  CLI::App command;
  MeshOptions options;
  add_mesh_options(command, options);
  return option_dicts(command);
}

py::list check_options() {
  CLI::App command;
  CheckOptions options;
  add_check_options(command, options);
  return option_dicts(command);
}

}  // namespace
}  // namespace hexwall::python

PYBIND11_MODULE(_hexwall, module) {
  using namespace hexwall::python;
  register_errors();
  bind_mesh_result(module);
  module.def("mesh", &mesh);
  module.def("check", &check);
  module.def("generate", &generate);
  module.def("mesh_options", &mesh_options);
  module.def("check_options", &check_options);
  module.attr("__version__") = hexwall::version();
}
