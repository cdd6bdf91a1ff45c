#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "surface/triangle_surface.h"

namespace hexwall {

/// A name for the opening nearest to a place.
struct NamedPlace {
  std::string name;
  Vec3 at;
};

/// Reads `[{"name": "inlet", "at": [x, y, z]}, ...]`.
/// \throws ReadError, naming the file and the entry, if the file is missing or not of this form, or
/// a name is invalid or occurs twice.
std::vector<NamedPlace> read_names(const std::filesystem::path& path);

/// One name per opening: that of the place whose nearest opening it is, or else that of a default
/// that fits (the name of an opened cap, at its centre), or else `loop_0`, `loop_1` … by its
/// number. \throws UsageError if two places have the same nearest opening, a place is farther from
/// the centre of its opening than 3 radii, or two openings would have the same name.
std::vector<std::string> assign_names(const std::vector<Vec3>& centers,
                                      const std::vector<double>& radii,
                                      const std::vector<NamedPlace>& places,
                                      const std::vector<NamedPlace>& defaults = {});

/// Whether OpenFOAM takes a name as that of a patch or zone, and nothing else of a wall has it.
bool is_valid_name(const std::string& name);

/// What makes a name valid, for messages.
std::string valid_name_rule();

/// The name with everything that makes it invalid replaced by '_'.
std::string valid_name(const std::string& name);

}  // namespace hexwall
