#include "surface/names.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/errors.h"

namespace hexwall {
namespace {

// Farther from the centre of an opening than this many radii, no one means that opening.
constexpr double greatest_distance = 3.0;

bool is_letter(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_';
}

bool is_allowed(char c) {
  return is_letter(c) || std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '.';
}

bool is_reserved(const std::string& name) {
  const std::string suffix = "_wall";
  const bool is_wall = name.size() >= suffix.size() &&
                       name.compare(name.size() - suffix.size(), suffix.size(), suffix) == 0;
  return is_wall || name == "wall" || name == "lumen" || name == "core" || name == "interface";
}

NamedPlace place_of(const nlohmann::json& entry) {
  if (!entry.is_object() || !entry.contains("name") || !entry.contains("at") ||
      !entry["name"].is_string()) {
    throw ReadError(R"(it needs a text "name" and a place "at")");
  }
  const nlohmann::json& at = entry["at"];
  const auto is_number = [](const nlohmann::json& x) { return x.is_number(); };
  if (!at.is_array() || at.size() != 3 || !std::all_of(at.begin(), at.end(), is_number)) {
    throw ReadError(R"("at" has to be three numbers, [x, y, z])");
  }
  NamedPlace place{entry["name"].get<std::string>(),
                   {at[0].get<double>(), at[1].get<double>(), at[2].get<double>()}};
  if (!is_valid_name(place.name)) {
    throw ReadError(
        fmt::format("'{}' cannot be the name of a patch: {}", place.name, valid_name_rule()));
  }
  return place;
}

std::vector<NamedPlace> places_of(const nlohmann::json& content) {
  if (!content.is_array()) throw ReadError("it has to hold a list of names, [...]");
  std::vector<NamedPlace> places;
  std::set<std::string> names;
  for (std::size_t i = 0; i < content.size(); ++i) {
    try {
      places.push_back(place_of(content[i]));
      if (names.insert(places.back().name).second) continue;
      throw ReadError(fmt::format("the name '{}' occurs twice", places.back().name));
    } catch (const ReadError& error) {
      throw ReadError(fmt::format("entry {} (counted from 1): {}", i + 1, error.what()));
    }
  }
  return places;
}

nlohmann::json parse_file(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) throw ReadError("the file cannot be opened");
  try {
    return nlohmann::json::parse(file);
  } catch (const nlohmann::json::exception& error) {
    throw ReadError(error.what());
  }
}

std::optional<std::size_t> opening_at(const Vec3& at, const std::vector<Vec3>& centers,
                                      const std::vector<double>& radii) {
  const auto nearest =
      std::min_element(centers.begin(), centers.end(), [&](const Vec3& a, const Vec3& b) {
        return (a - at).squaredNorm() < (b - at).squaredNorm();
      });
  const auto i = static_cast<std::size_t>(nearest - centers.begin());
  const bool is_near = i < centers.size() && (*nearest - at).norm() <= greatest_distance * radii[i];
  return is_near ? std::optional(i) : std::nullopt;
}

[[noreturn]] void refuse_far(const NamedPlace& place, const std::vector<Vec3>& centers) {
  std::string list;
  for (const Vec3& c : centers) list += fmt::format(" ({:.6g}, {:.6g}, {:.6g})", c[0], c[1], c[2]);
  throw UsageError(fmt::format("no opening is near '{}' at ({:.6g}, {:.6g}, {:.6g}): they are at{}",
                               place.name, place.at[0], place.at[1], place.at[2], list));
}

}  // namespace

std::vector<NamedPlace> read_names(const std::filesystem::path& path) {
  try {
    return places_of(parse_file(path));
  } catch (const ReadError& error) {
    throw ReadError(fmt::format("cannot read the names '{}': {}", path.string(), error.what()));
  }
}

std::vector<std::string> assign_names(const std::vector<Vec3>& centers,
                                      const std::vector<double>& radii,
                                      const std::vector<NamedPlace>& places,
                                      const std::vector<NamedPlace>& defaults) {
  std::vector<std::string> names(centers.size());
  for (const NamedPlace& place : places) {
    const auto opening = opening_at(place.at, centers, radii);
    if (!opening) refuse_far(place, centers);
    std::string& name = names[*opening];
    if (!name.empty()) {
      throw UsageError(
          fmt::format("'{}' and '{}' name the same opening: the one at the place of "
                      "one of them is missing, or the place is wrong",
                      name, place.name));
    }
    name = place.name;
  }
  for (const NamedPlace& place : defaults) {
    const auto opening = opening_at(place.at, centers, radii);
    const bool is_taken = std::find(names.begin(), names.end(), place.name) != names.end();
    if (opening && names[*opening].empty() && !is_taken) names[*opening] = place.name;
  }
  std::set<std::string> used;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i].empty()) names[i] = fmt::format("loop_{}", i);
    if (used.insert(names[i]).second) continue;
    throw UsageError(fmt::format("two openings have the name '{}': choose another one", names[i]));
  }
  return names;
}

bool is_valid_name(const std::string& name) {
  return !name.empty() && is_letter(name.front()) &&
         std::all_of(name.begin(), name.end(), is_allowed) && !is_reserved(name);
}

std::string valid_name_rule() {
  return "letters, digits, '_', '-' and '.' are allowed, beginning with a letter or '_'; wall, "
         "lumen, core, interface and all that ends in _wall are taken";
}

std::string valid_name(const std::string& name) {
  std::string result = name;
  for (char& c : result) {
    if (!is_allowed(c)) c = '_';
  }
  if (result.empty() || !is_letter(result.front())) result = '_' + result;
  if (is_reserved(result)) result += '_';
  return result;
}

}  // namespace hexwall
