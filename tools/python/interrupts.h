#pragma once

#include <functional>
#include <pybind11/pybind11.h>

#include "core/progress.h"

namespace hexwall::python {

/// Does `work` while other Python threads run. Ctrl-C ends it with KeyboardInterrupt, on the main
/// thread; so does `is_cancelled`, a callable or None, with `Cancelled` once it returns true.
void run_without_gil(const pybind11::object& is_cancelled, const std::function<void()>& work);

/// Calls `callback`, a callable or None, with stage, number and count. What it raises ends the
/// work.
ProgressCallback progress_callback(const pybind11::object& callback);

}  // namespace hexwall::python
