#pragma once

#include <string_view>

namespace hexwall {

/// The script of the report's 3-D view, from tools/view; empty if hexwall was built without it.
std::string_view view_script();

}  // namespace hexwall
