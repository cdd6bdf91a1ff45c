#include "surface/units.h"

#include <array>
#include <cmath>

#include <fmt/format.h>

#include "surface/orient.h"

namespace hexwall {
namespace {

struct Unit {
  const char* name;
  double metres;
};
constexpr std::array<Unit, 4> units{{{"mm", 1e-3}, {"cm", 1e-2}, {"m", 1.0}, {"um", 1e-6}}};

// In metres. From the smallest arteries that are imaged to a whole body; from an arteriole to a
// dilated atrium.
constexpr double least_diagonal = 1e-3;
constexpr double greatest_diagonal = 2.0;
constexpr double least_radius = 1e-4;
constexpr double greatest_radius = 0.05;

// Below this fraction of the diagonal the radius is that of no tube: the surface is flat.
constexpr double flat_radius = 1e-6;

struct Size {
  double diagonal, radius;
};

bool is_vessel(const Size& size, double metres) {
  const double diagonal = size.diagonal * metres;
  const double radius = size.radius * metres;
  const bool is_flat = size.radius < flat_radius * size.diagonal;
  return diagonal >= least_diagonal && diagonal <= greatest_diagonal &&
         (is_flat || (radius >= least_radius && radius <= greatest_radius));
}

std::string length(double metres) {
  return metres < 1.0 ? fmt::format("{:.3g} mm", 1e3 * metres) : fmt::format("{:.4g} m", metres);
}

}  // namespace

std::optional<std::string> unit_warning(const TriangleSurface& surface, const Connectivity& mesh,
                                        double metres_per_unit) {
  const Size size{bounding_box_diagonal(surface),
                  2.0 * std::abs(signed_volume(surface, mesh)) / total_area(surface)};
  if (is_vessel(size, metres_per_unit)) return std::nullopt;
  std::string fitting;
  for (const Unit& unit : units) {
    if (!is_vessel(size, unit.metres)) continue;
    fitting += fmt::format("{}{}", fitting.empty() ? "" : " or ", unit.name);
  }
  return fmt::format(
      "in the unit stated the surface is {} across with a mean radius of {}, which no vessel has; "
      "{}",
      length(metres_per_unit * size.diagonal), length(metres_per_unit * size.radius),
      fitting.empty() ? "it has the size of a vessel in none of mm, cm, m, um"
                      : fmt::format("it would be one in {}", fitting));
}

}  // namespace hexwall
