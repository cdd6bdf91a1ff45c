#include "errors.h"

#include <exception>
#include <pybind11/pybind11.h>
#include <utility>

#include "core/cancel.h"
#include "core/errors.h"

namespace hexwall::python {
namespace {

namespace py = pybind11;

const char* class_name(ExitCode code) {
  switch (code) {
    case ExitCode::usage:
      return "UsageError";
    case ExitCode::read:
      return "ReadError";
    case ExitCode::topology:
      return "TopologyError";
    case ExitCode::geometry:
      return "GeometryError";
    case ExitCode::meshing:
      return "MeshingError";
    case ExitCode::write:
      return "WriteError";
    default:
      return "Error";
  }
}

void raise(const char* name, const char* message) {
  const py::object type = py::module_::import("hexwall.errors").attr(name);
  PyErr_SetString(type.ptr(), message);
}

}  // namespace

void register_errors() {
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(std::move(thrown));
    } catch (const Error& error) {
      raise(class_name(error.code()), error.what());
    } catch (const Cancelled& cancelled) {
      raise("Cancelled", cancelled.what());
    }
  });
}

}  // namespace hexwall::python
