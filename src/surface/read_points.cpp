#include "surface/read_points.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>

#include <fmt/format.h>

#include "core/errors.h"

namespace hexwall {

namespace {

// The numbers of each line, as many as `columns` names, separated by blanks.
std::vector<std::vector<double>> read_rows(const std::filesystem::path& path, std::size_t count,
                                           const std::string& columns) {
  std::ifstream file(path);
  if (!file) throw ReadError(fmt::format("cannot read '{}': no such file", path.string()));
  std::vector<std::vector<double>> rows;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    line.erase(std::min(line.find('#'), line.size()));
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream words(line);
    if ((words >> std::ws).eof()) continue;
    std::vector<double> row;
    for (double x = 0.0; words >> x && std::isfinite(x);) row.push_back(x);
    if (row.size() != count || !words.eof()) {
      throw ReadError(fmt::format("cannot read '{}', line {}: {} numbers {} are needed",
                                  path.string(), number, count, columns));
    }
    rows.push_back(std::move(row));
  }
  if (rows.empty()) throw ReadError(fmt::format("'{}' holds no points", path.string()));
  return rows;
}

}  // namespace

std::vector<Vec3> read_points(const std::filesystem::path& path) {
  std::vector<Vec3> points;
  for (const auto& row : read_rows(path, 3, "x y z")) points.emplace_back(row[0], row[1], row[2]);
  return points;
}

std::vector<PointValue> read_point_values(const std::filesystem::path& path) {
  std::vector<PointValue> values;
  for (const auto& row : read_rows(path, 4, "x y z value")) {
    values.push_back({Vec3(row[0], row[1], row[2]), row[3]});
  }
  return values;
}

}  // namespace hexwall
