#pragma once

namespace hexwall::python {

/// From now on exceptions of hexwall arrive in Python as those of `hexwall.errors`.
void register_errors();

}  // namespace hexwall::python
