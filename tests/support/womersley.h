#pragma once

#include <complex>

namespace hexwall {

/// Bessel function J_n of a complex argument, by its series: good for |z| < 20.
inline std::complex<double> bessel(int n, std::complex<double> z) {
  std::complex<double> term = n == 0 ? 1.0 : 0.5 * z;
  std::complex<double> sum = term;
  for (int k = 1; k < 60; ++k) {
    term *= -0.25 * z * z / static_cast<double>(k * (k + n));
    sum += term;
  }
  return sum;
}

/// Womersley's solution in a circle: amplitudes for the mean velocity cos(ωt).
struct Womersley {
  double radius;
  double omega_over_nu;

  std::complex<double> k() const {  // i^{3/2} sqrt(ω/ν)
    return std::sqrt(std::complex<double>(0.0, -omega_over_nu));
  }
  std::complex<double> scale() const {
    const std::complex<double> z = k() * radius;
    return 1.0 / (1.0 - 2.0 * bessel(1, z) / (z * bessel(0, z)));
  }
  std::complex<double> velocity(double r) const {
    return (1.0 - bessel(0, k() * r) / bessel(0, k() * radius)) * scale();
  }
  /// -du/dr at the wall.
  std::complex<double> wall_shear_rate() const {
    const std::complex<double> z = k() * radius;
    return -k() * bessel(1, z) / bessel(0, z) * scale();
  }
};

}  // namespace hexwall
