#pragma once

#include <vector>

namespace hexwall::test {

/// A layer of a thick-walled cylinder of linear elastic material.
struct ElasticLayer {
  double outer_radius;
  double young;    ///< modulus E, in the unit of the pressure
  double poisson;  ///< ratio, < 0.5
};

/// Lamé's solution: a thick-walled cylinder in plane strain under inner pressure, its layers
/// bonded. In each layer u = a r + b / r; the 2n constants follow from the pressure, zero traction
/// outside, and equal displacement and radial stress on both sides of each interface.
class LameCylinder {
 public:
  LameCylinder(double inner_radius, const std::vector<ElasticLayer>& layers, double pressure);
  double radial_displacement(double r) const;
  double radial_stress(double r) const;
  double hoop_stress(double r) const;

 private:
  struct Constants {
    double outer_radius;
    double a, b;         ///< of the displacement
    double bulk, shear;  ///< 2 (λ + μ) and 2 μ
  };
  const Constants& at(double r) const;
  std::vector<Constants> layers_;
};

}  // namespace hexwall::test
