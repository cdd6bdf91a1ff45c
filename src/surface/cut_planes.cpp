#include "surface/cut_planes.h"

#include <array>
#include <charconv>
#include <cmath>
#include <fstream>

#include <fmt/format.h>

#include "core/errors.h"
#include "surface/names.h"

namespace hexwall {
namespace {

std::vector<std::string> fields_of(std::string line) {
  line.resize(std::min(line.find('#'), line.size()));
  constexpr const char* separators = " \t\r,";
  std::vector<std::string> fields;
  for (std::size_t at = line.find_first_not_of(separators); at != std::string::npos;) {
    const std::size_t end = std::min(line.find_first_of(separators, at), line.size());
    fields.push_back(line.substr(at, end - at));
    at = line.find_first_not_of(separators, end);
  }
  return fields;
}

std::optional<double> as_number(const std::string& field) {
  double value = 0.0;
  const char* last = field.data() + field.size();
  const auto [end, error] = std::from_chars(field.data(), last, value);
  if (error != std::errc{} || end != last || !std::isfinite(value)) return std::nullopt;
  return value;
}

void read_options(const std::vector<std::string>& fields, CutPlane& plane) {
  std::size_t next = 6;
  if (next < fields.size()) plane.radius = as_number(fields[next]);
  if (plane.radius) ++next;
  if (plane.radius && *plane.radius <= 0.0) throw ReadError("the radius has to be positive");
  if (next < fields.size()) plane.name = fields[next++];
  if (!plane.name.empty() && !is_valid_name(plane.name)) {
    throw ReadError(fmt::format("'{}' cannot be the name of an opening", plane.name));
  }
  if (next < fields.size()) throw ReadError(fmt::format("'{}' is one too many", fields[next]));
}

CutPlane plane_of(const std::vector<std::string>& fields) {
  if (fields.size() < 6) {
    throw ReadError(
        fmt::format("x y z nx ny nz [radius] [name] are expected, but there are only {} values",
                    fields.size()));
  }
  std::array<double, 6> numbers{};
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const auto number = as_number(fields[i]);
    if (!number) throw ReadError(fmt::format("'{}' is not a finite number", fields[i]));
    numbers[i] = *number;
  }
  CutPlane plane{
      {numbers[0], numbers[1], numbers[2]}, {numbers[3], numbers[4], numbers[5]}, {}, {}};
  if (plane.normal.norm() == 0.0) throw ReadError("the normal is 0");
  plane.normal.normalize();
  read_options(fields, plane);
  return plane;
}

}  // namespace

std::vector<CutPlane> read_cut_planes(const std::filesystem::path& path) {
  const auto refuse = [&](const std::string& message) {
    throw ReadError(fmt::format("cannot read the cuts '{}': {}", path.string(), message));
  };
  std::ifstream file(path);
  if (!file) refuse("the file cannot be opened");
  std::vector<CutPlane> planes;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    const std::vector<std::string> fields = fields_of(line);
    if (fields.empty()) continue;
    try {
      planes.push_back(plane_of(fields));
    } catch (const ReadError& error) {
      refuse(fmt::format("line {}: {}", number, error.what()));
    }
  }
  if (planes.empty()) refuse("it holds no cut");
  return planes;
}

}  // namespace hexwall
