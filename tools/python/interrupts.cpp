#include "interrupts.h"

#include <chrono>
#include <string>

#include "core/cancel.h"

namespace hexwall::python {
namespace {

namespace py = pybind11;
using Clock = std::chrono::steady_clock;

// Python is asked that often, since it has to be waited for.
constexpr std::chrono::milliseconds interval(20);

}  // namespace

void run_without_gil(const py::object& is_cancelled, const std::function<void()>& work) {
  const py::gil_scoped_release release;
  Clock::time_point asked = Clock::now();
  const CancelScope scope([&] {
    const Clock::time_point now = Clock::now();
    if (now - asked < interval) return false;
    asked = now;
    const py::gil_scoped_acquire acquire;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    return !is_cancelled.is_none() && is_cancelled().cast<bool>();
  });
  work();
}

ProgressCallback progress_callback(const py::object& callback) {
  if (callback.is_none()) return {};
  return [&callback](const std::string& stage, int index, int count) {
    const py::gil_scoped_acquire acquire;
    callback(stage, index, count);
  };
}

}  // namespace hexwall::python
