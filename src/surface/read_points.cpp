#include "surface/read_points.h"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>

#include <fmt/format.h>

#include "core/errors.h"

namespace hexwall {

std::vector<Vec3> read_points(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) throw ReadError(fmt::format("cannot read '{}': no such file", path.string()));
  std::vector<Vec3> points;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    line.erase(std::min(line.find('#'), line.size()));
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream words(line);
    if ((words >> std::ws).eof()) continue;
    Vec3 p;
    std::string rest;
    if (!(words >> p.x() >> p.y() >> p.z()) || words >> rest || !p.allFinite()) {
      throw ReadError(fmt::format("cannot read '{}', line {}: three coordinates x y z are needed",
                                  path.string(), number));
    }
    points.push_back(p);
  }
  if (points.empty()) throw ReadError(fmt::format("'{}' holds no points", path.string()));
  return points;
}

}  // namespace hexwall
