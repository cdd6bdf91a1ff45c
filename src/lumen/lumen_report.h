#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "lumen/lumen.h"

namespace hexwall {

/// What is known of the mesh of a lumen: the key `lumen` of the report. README.md documents it.
nlohmann::ordered_json lumen_json(const LumenResult& result);

/// A few lines for people. \param units of the mesh.
std::string lumen_summary(const LumenResult& result, const std::string& units);

}  // namespace hexwall
