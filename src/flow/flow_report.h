#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "flow/flow_setup.h"

namespace hexwall {

/// Everything about a flow but the values on faces, in SI units. README.md documents the keys.
nlohmann::ordered_json flow_json(const FlowSetup& setup);

/// A few lines for people, warnings included.
std::string flow_summary(const FlowSetup& setup);

}  // namespace hexwall
