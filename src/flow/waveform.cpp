#include "flow/waveform.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <numbers>
#include <optional>
#include <sstream>
#include <string>

#include <fmt/format.h>

#include "core/errors.h"

namespace hexwall {
namespace {

using Complex = std::complex<double>;

double angular_frequency(double period) {
  return 2.0 * std::numbers::pi / period;
}

/// The two numbers of a line; none if there is nothing but a comment.
std::optional<std::array<double, 2>> entry_of(std::string line, const std::string& where) {
  line = line.substr(0, line.find('#'));
  std::replace(line.begin(), line.end(), ',', ' ');
  std::istringstream words(line);
  std::string word;
  if (!(words >> word)) return std::nullopt;
  words.seekg(0);
  std::array<double, 2> entry{};
  if (words >> entry[0] >> entry[1] && !(words >> word) && std::isfinite(entry[0]) &&
      std::isfinite(entry[1])) {
    return entry;
  }
  throw ReadError(fmt::format("{}: '{}' is not a time and a flow rate", where, line));
}

void append(Waveform& waveform, const std::array<double, 2>& entry, const std::string& where) {
  const bool is_first = waveform.times.empty();
  if (is_first && entry[0] != 0.0) {
    throw ReadError(fmt::format("{}: the first time is {}, but must be 0", where, entry[0]));
  }
  if (!is_first && entry[0] <= waveform.times.back()) {
    throw ReadError(fmt::format("{}: times must rise, but {} follows {}", where, entry[0],
                                waveform.times.back()));
  }
  waveform.times.push_back(entry[0]);
  waveform.flows.push_back(entry[1]);
}

void check_cycle(const Waveform& waveform, const std::string& file) {
  if (waveform.times.size() < 3) {
    throw ReadError(fmt::format("{}: a waveform needs three rows or more, there are {}", file,
                                waveform.times.size()));
  }
  const auto [least, greatest] = std::minmax_element(waveform.flows.begin(), waveform.flows.end());
  if (std::abs(waveform.flows.front() - waveform.flows.back()) > 0.01 * (*greatest - *least)) {
    throw ReadError(fmt::format(
        "{}: the last row ends the cycle at {} s and must repeat the first flow rate, {}, but has "
        "{}: add a row",
        file, waveform.period(), waveform.flows.front(), waveform.flows.back()));
  }
  if (mean(waveform) <= 0.0) {
    throw UsageError(fmt::format(
        "{}: the mean flow rate is {}: it must be positive, into the lumen at the inlet", file,
        mean(waveform)));
  }
}

}  // namespace

Waveform typical_waveform(double period) {
  // Flow over its mean at every twentieth of the cycle.
  constexpr std::array<double, 20> shape{0.62, 0.70, 1.20, 1.72, 1.90, 1.80, 1.58,
                                         1.36, 1.16, 1.02, 1.04, 1.08, 1.02, 0.94,
                                         0.87, 0.81, 0.76, 0.71, 0.67, 0.64};
  Waveform waveform;
  for (std::size_t i = 0; i <= shape.size(); ++i) {
    waveform.times.push_back(period * static_cast<double>(i) / static_cast<double>(shape.size()));
    waveform.flows.push_back(shape[i % shape.size()]);
  }
  const double factor = 1.0 / mean(waveform);
  for (double& flow : waveform.flows) flow *= factor;
  return waveform;
}

Waveform read_waveform(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) throw ReadError(fmt::format("cannot open the waveform '{}'", path.string()));
  Waveform waveform;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    const std::string where = fmt::format("{}, line {}", path.string(), number);
    if (const auto entry = entry_of(line, where)) append(waveform, *entry, where);
  }
  check_cycle(waveform, path.string());
  waveform.flows.back() = waveform.flows.front();
  return waveform;
}

double mean(const Waveform& w) {
  double sum = 0.0;
  for (std::size_t i = 1; i < w.times.size(); ++i)
    sum += 0.5 * (w.flows[i] + w.flows[i - 1]) * (w.times[i] - w.times[i - 1]);
  return sum / w.period();
}

double FourierSeries::operator()(double time) const {
  double value = 0.0;
  for (std::size_t n = 0; n < coefficients.size(); ++n) {
    const double angle = angular_frequency(period) * static_cast<double>(n) * time;
    value += (coefficients[n] * std::polar(1.0, angle)).real();
  }
  return value;
}

FourierSeries fourier_series(const Waveform& w, int harmonics) {
  FourierSeries series{w.period(), {Complex(mean(w))}};
  for (int n = 1; n <= harmonics; ++n) {
    // Integrated by parts twice: the slopes are piecewise constant, the function is periodic.
    const Complex i_omega(0.0, angular_frequency(w.period()) * n);
    Complex sum = 0.0;
    for (std::size_t k = 1; k < w.times.size(); ++k) {
      const double slope = (w.flows[k] - w.flows[k - 1]) / (w.times[k] - w.times[k - 1]);
      sum += slope * (std::exp(-i_omega * w.times[k - 1]) - std::exp(-i_omega * w.times[k]));
    }
    series.coefficients.push_back(2.0 * sum / (i_omega * i_omega * w.period()));
  }
  return series;
}

double deviation(const FourierSeries& series, const Waveform& w) {
  const auto [least, greatest] = std::minmax_element(w.flows.begin(), w.flows.end());
  if (*greatest <= *least) return 0.0;
  double largest = 0.0;
  for (std::size_t i = 0; i < w.times.size(); ++i)
    largest = std::max(largest, std::abs(series(w.times[i]) - w.flows[i]));
  return largest / (*greatest - *least);
}

}  // namespace hexwall
