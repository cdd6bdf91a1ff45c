#include "flow/blood.h"

#include <cmath>

#include <fmt/format.h>

#include "core/errors.h"

namespace hexwall {

double viscosity_at(const Blood& blood, double shear_rate) {
  if (blood.model == FluidModel::newtonian) return blood.viscosity;
  const double x = blood.relaxation_time * shear_rate;
  return blood.viscosity + (blood.viscosity_at_rest - blood.viscosity) *
                               std::pow(1.0 + x * x, (blood.power - 1.0) / 2.0);
}

std::string name(FluidModel model) {
  return model == FluidModel::carreau ? "carreau" : "newtonian";
}

void check(const Blood& blood) {
  const auto require = [](double value, const char* option, const char* unit) {
    if (std::isfinite(value) && value > 0.0) return;
    throw UsageError(fmt::format("{} must be a positive number of {}", option, unit));
  };
  require(blood.density, "--density", "kg/m³");
  require(blood.viscosity, "--viscosity", "Pa s");
  if (blood.model == FluidModel::carreau && blood.viscosity >= blood.viscosity_at_rest) {
    throw UsageError(fmt::format(
        "--viscosity {} Pa s with --fluid carreau is that at infinite shear rate, and must be less "
        "than {} Pa s, that at rest",
        blood.viscosity, blood.viscosity_at_rest));
  }
}

}  // namespace hexwall
