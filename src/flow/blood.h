#pragma once

#include <string>

namespace hexwall {

enum class FluidModel { newtonian, carreau };

/// Blood, in SI units. The Carreau parameters are those of Cho and Kensey (Biorheology 28:241,
/// 1991), fitted to measurements of whole human blood; the constant viscosity is their limit at
/// high shear rates, and the density is the usual 1060 kg/m³.
struct Blood {
  FluidModel model = FluidModel::newtonian;
  double density = 1060.0;            ///< kg/m³
  double viscosity = 3.45e-3;         ///< Pa s: constant, or at infinite shear rate
  double viscosity_at_rest = 56e-3;   ///< Pa s; Carreau only, as what follows
  double relaxation_time = 3.313;     ///< s
  double power = 0.3568;              ///< n: the viscosity falls with the shear rate to the n - 1
  double kinematic_viscosity() const  ///< m²/s, of `viscosity`
  {
    return viscosity / density;
  }
};

/// Dynamic viscosity at a shear rate in 1/s: μ∞ + (μ0 - μ∞)(1 + (λγ)²)^((n-1)/2) for Carreau.
double viscosity_at(const Blood& blood, double shear_rate);

/// "newtonian" or "carreau".
std::string name(FluidModel model);

/// \throws UsageError unless density and viscosities are positive and finite and, with Carreau, the
/// viscosity at rest is at least that at infinite shear rate.
void check(const Blood& blood);

}  // namespace hexwall
