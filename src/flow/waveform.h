#pragma once

#include <complex>
#include <filesystem>
#include <vector>

namespace hexwall {

/// A flow rate over one cycle, linear between the entries and repeated after it.
struct Waveform {
  std::vector<double> times;  ///< s, rising from 0; the last is the period
  std::vector<double> flows;  ///< any unit; the last is the first
  double period() const { return times.back(); }
};

/// A pulse as in a large artery near the heart or in the neck: rises to 1.8 times its mean in
/// systole, has a notch and a second, lower hump, then falls to 0.6 of it at the end of diastole.
/// Drawn as a typical shape, not measured on anybody. Mean 1.
/// \param period s, positive
Waveform typical_waveform(double period);

/// Reads `time flow` on each line, in s and any unit, separated by blanks or commas; what follows a
/// '#' is a comment. The first time is 0, the last row ends the cycle and repeats the first flow.
/// \throws ReadError, naming file and line, if it is missing or of other form, UsageError if the
/// mean is not positive.
Waveform read_waveform(const std::filesystem::path& path);

/// Mean over the cycle.
double mean(const Waveform& waveform);

/// f(t) ≈ Re Σ_n c_n e^{2πi n t/T}.
struct FourierSeries {
  double period = 0.0;
  std::vector<std::complex<double>> coefficients;  ///< c_0 … c_N; c_0 is the mean
  double operator()(double time) const;
};

/// The first harmonics of `waveform`, integrated exactly.
FourierSeries fourier_series(const Waveform& waveform, int harmonics);

/// Greatest distance of the series from the entries of the table, relative to the table's range;
/// 0 for a constant.
double deviation(const FourierSeries& series, const Waveform& waveform);

}  // namespace hexwall
