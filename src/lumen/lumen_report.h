#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "lumen/lumen.h"

namespace hexwall {

/// What is known of the mesh of a lumen: the key `lumen` of the report. README.md documents it.
nlohmann::ordered_json lumen_json(const LumenResult& result);

/// Cells, quality and warnings: a few lines for people. \param units of the mesh.
std::string lumen_summary(const LumenResult& result, const std::string& units);

/// A line for each opening, for those who don't say more of it than its area.
std::string openings_summary(const LumenResult& result, const std::string& units);

}  // namespace hexwall
