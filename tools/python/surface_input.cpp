#include "surface_input.h"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <limits>
#include <mutex>
#include <pybind11/numpy.h>
#include <vector>

#include <fmt/format.h>

#include "surface/read_memory.h"

namespace hexwall::python {
namespace {

namespace py = pybind11;
using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Ints = py::array_t<long long, py::array::c_style | py::array::forcecast>;

constexpr long long greatest_index = std::numeric_limits<int>::max();

std::vector<Vec3> points_of(const py::handle& value) {
  const auto array = Doubles::ensure(value);
  if (!array) throw py::error_already_set();
  if (array.ndim() != 2 || array.shape(1) != 3) {
    throw py::value_error("points is an array of the shape (n, 3)");
  }
  std::vector<Vec3> points;
  points.reserve(static_cast<std::size_t>(array.shape(0)));
  for (py::ssize_t i = 0; i < array.shape(0); ++i) {
    points.emplace_back(array.at(i, 0), array.at(i, 1), array.at(i, 2));
  }
  return points;
}

std::vector<std::vector<int>> polygons_of(const py::handle& value) {
  const py::array plain = py::array::ensure(value);
  if (!plain || (plain.dtype().kind() != 'i' && plain.dtype().kind() != 'u')) {
    throw py::type_error("triangles is an array of integers");
  }
  const auto array = Ints::ensure(plain);
  if (array.ndim() != 2 || array.shape(1) < 3) {
    throw py::value_error("triangles is an array of the shape (n, 3)");
  }
  std::vector<std::vector<int>> polygons(static_cast<std::size_t>(array.shape(0)));
  for (py::ssize_t f = 0; f < array.shape(0); ++f) {
    for (py::ssize_t k = 0; k < array.shape(1); ++k) {
      // What does not fit is out of range however it is cut: there are fewer points.
      const long long v = std::clamp(array.at(f, k), -1LL, greatest_index);
      polygons[static_cast<std::size_t>(f)].push_back(static_cast<int>(v));
    }
  }
  return polygons;
}

std::vector<SurfaceArray> arrays_of(const py::object& arrays, std::size_t tuples) {
  std::vector<SurfaceArray> result;
  if (arrays.is_none()) return result;
  for (const auto& [key, value] : arrays.cast<py::dict>()) {
    const auto name = key.cast<std::string>();
    const auto array = Doubles::ensure(value);
    if (!array) throw py::error_already_set();
    if (array.ndim() < 1 || array.ndim() > 2 || array.shape(0) != static_cast<long>(tuples)) {
      throw py::value_error(fmt::format("the array '{}' needs {} values", name, tuples));
    }
    const int components = array.ndim() == 2 ? static_cast<int>(array.shape(1)) : 1;
    result.push_back({name, components, {array.data(), array.data() + array.size()}});
  }
  return result;
}

// VTK's readers share a message window.
ReadResult read_alone(const std::string& path) {
  static std::mutex mutex;
  const py::gil_scoped_release release;
  const std::lock_guard lock(mutex);
  return read_surface(path);
}

SurfaceInput from_file(const std::string& path) {
  const auto start = std::chrono::steady_clock::now();
  SurfaceInput input{path, read_alone(path), 0.0};
  input.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return input;
}

void append(std::vector<SurfaceArray>& to, std::vector<SurfaceArray> arrays) {
  to.insert(to.end(), std::make_move_iterator(arrays.begin()),
            std::make_move_iterator(arrays.end()));
}

}  // namespace

SurfaceInput surface_input(const py::object& surface, const py::object& point_arrays,
                           const py::object& cell_arrays) {
  if (py::isinstance<py::str>(surface) || py::hasattr(surface, "__fspath__")) {
    SurfaceInput input =
        from_file(py::module_::import("os").attr("fspath")(surface).cast<std::string>());
    const TriangleSurface& s = input.read.surface;
    append(input.read.point_arrays, arrays_of(point_arrays, s.points.size()));
    append(input.read.cell_arrays, arrays_of(cell_arrays, s.triangles.size()));
    return input;
  }
  if (!py::isinstance<py::sequence>(surface) || py::len(surface) != 2) {
    throw py::type_error("a surface is the path of a file or a pair (points, triangles)");
  }
  const auto pair = py::reinterpret_borrow<py::sequence>(surface);
  PolygonSoup soup{points_of(pair[0]), polygons_of(pair[1]), {}, {}, {}};
  soup.point_arrays = arrays_of(point_arrays, soup.points.size());
  soup.polygon_arrays = arrays_of(cell_arrays, soup.polygons.size());
  return {"memory", read_memory(std::move(soup)), 0.0};
}

}  // namespace hexwall::python
