#include "flow/flow_setup.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "core/errors.h"
#include "flow/cross_section.h"
#include "hex/cell_faces.h"

namespace hexwall {
namespace {

using std::numbers::pi;

constexpr double default_reynolds = 300.0;
constexpr double laminar_reynolds = 2000.0;
// Of the typical pulse, 16 miss 2 % of the range.
constexpr int harmonics = 16;
constexpr double greatest_deviation = 0.05;
constexpr int times_per_cycle = 100;

void check_options(const FlowOptions& options) {
  check(options.blood);
  if (options.reynolds && options.flow_rate)
    throw UsageError("--re and --flow-rate exclude each other");
  const auto require = [](bool is_given, double value, const char* what) {
    if (is_given && !(std::isfinite(value) && value > 0.0))
      throw UsageError(fmt::format("{} must be a positive number", what));
  };
  require(options.reynolds.has_value(), options.reynolds.value_or(0.0), "--re");
  require(options.flow_rate.has_value(), options.flow_rate.value_or(0.0), "--flow-rate");
  require(options.pulsatile, options.period, "--period");
  if (options.pulsatile && options.cycles < 1) throw UsageError("--cycles must be 1 or more");
}

/// Faces of a patch in the order in which OpenFOAM gets them: by cell.
std::vector<CellFace> faces_of_patch(const CellMesh& mesh, const std::string& name) {
  const auto found = std::find_if(mesh.patches.begin(), mesh.patches.end(),
                                  [&](const CellPatch& patch) { return patch.name == name; });
  if (found == mesh.patches.end())
    throw Error(ExitCode::internal, "the opening '" + name + "' is no patch of the mesh");
  const auto of_patches = faces_of_patches(mesh, neighbours_of_cells(mesh));
  std::vector<CellFace> faces;
  for (const LocalFace& face : of_patches[found - mesh.patches.begin()]) {
    faces.push_back({cell_face(mesh, face.cell, face.local), face.cell});
  }
  return faces;
}

const LumenOpening& inlet_of(const std::vector<LumenOpening>& openings) {
  const auto is_inlet = [](const LumenOpening& opening) { return opening.inlet; };
  const auto count = std::count_if(openings.begin(), openings.end(), is_inlet);
  if (count != 1 || openings.size() < 2) {
    throw UsageError(fmt::format(
        "a flow needs one inlet and at least one outlet, but {} of the {} openings are inlets",
        count, openings.size()));
  }
  return *std::find_if(openings.begin(), openings.end(), is_inlet);
}

std::string names_of(const std::vector<FlowOutlet>& outlets) {
  std::string names;
  for (const FlowOutlet& outlet : outlets) names += (names.empty() ? "" : ", ") + outlet.patch;
  return names;
}

void set_given_shares(const std::map<std::string, double>& split,
                      std::vector<FlowOutlet>& outlets) {
  for (const auto& entry : split) {
    const std::string& name = entry.first;
    const double share = entry.second;
    const auto is_named = [&](const FlowOutlet& outlet) { return outlet.patch == name; };
    const auto outlet = std::find_if(outlets.begin(), outlets.end(), is_named);
    if (outlet == outlets.end()) {
      throw UsageError(fmt::format("--split: there is no outlet '{}'; the outlets are {}", name,
                                   names_of(outlets)));
    }
    if (!(std::isfinite(share) && share > 0.0))
      throw UsageError(fmt::format("--split: the share of '{}' must be positive", name));
    outlet->share = share;
  }
  if (split.size() < outlets.size())
    throw UsageError("--split must give the shares of all outlets: " + names_of(outlets));
}

std::vector<FlowOutlet> outlets_of(const std::vector<LumenOpening>& openings,
                                   const std::map<std::string, double>& split,
                                   double metres_per_unit) {
  std::vector<FlowOutlet> outlets;
  for (const LumenOpening& opening : openings) {
    if (opening.inlet) continue;
    FlowOutlet outlet{opening.patch, opening.area * metres_per_unit * metres_per_unit};
    outlet.radius = std::sqrt(outlet.area / pi);
    outlet.share = std::pow(outlet.radius, 3);
    outlets.push_back(outlet);
  }
  if (!split.empty()) set_given_shares(split, outlets);
  double sum = 0.0;
  for (const FlowOutlet& outlet : outlets) sum += outlet.share;
  for (FlowOutlet& outlet : outlets) outlet.share /= sum;
  const auto by_share = [](const FlowOutlet& a, const FlowOutlet& b) { return a.share < b.share; };
  std::max_element(outlets.begin(), outlets.end(), by_share)->fixes_pressure = true;
  return outlets;
}

double mean_flow_rate(const FlowOptions& options, const FlowSetup& setup) {
  if (options.flow_rate) return *options.flow_rate;
  if (!options.reynolds && options.pulsatile && options.waveform) return mean(*options.waveform);
  return options.reynolds.value_or(default_reynolds) * options.blood.kinematic_viscosity() *
         setup.inlet_area / setup.inlet_diameter;
}

/// Velocities u_f on the faces, along the direction of the flow.
std::vector<Vec3> along(const Vec3& direction, const std::vector<double>& speeds) {
  std::vector<Vec3> velocities;
  velocities.reserve(speeds.size());
  for (const double speed : speeds) velocities.emplace_back(speed * direction);
  return velocities;
}

/// Amplitude of each harmonic on each face, as a velocity.
std::vector<std::vector<std::complex<double>>> amplitudes(const CrossSection& section,
                                                          const FourierSeries& flow, double nu) {
  std::vector<std::vector<std::complex<double>>> result;
  for (std::size_t n = 0; n < flow.coefficients.size(); ++n) {
    const double omega = 2.0 * pi * static_cast<double>(n) / flow.period;
    result.push_back(section.oscillating(omega / nu));
    for (std::complex<double>& u : result.back()) u *= flow.coefficients[n] / section.area();
  }
  return result;
}

Pulse pulse_of(const CrossSection& section, const FourierSeries& flow, double nu, int cycles) {
  Pulse pulse;
  pulse.period = flow.period;
  pulse.cycles = cycles;
  const double radius = std::sqrt(section.area() / pi);
  pulse.womersley = radius * std::sqrt(2.0 * pi / (flow.period * nu));
  const auto harmonic = amplitudes(section, flow, nu);
  for (int i = 0; i <= times_per_cycle; ++i) {
    const double phase = static_cast<double>(i % times_per_cycle) / times_per_cycle;
    pulse.times.push_back(flow.period * i / times_per_cycle);
    pulse.flows.push_back(flow(phase * flow.period));
    std::vector<double> speeds(section.face_areas().size(), 0.0);
    for (std::size_t n = 0; n < harmonic.size(); ++n) {
      const auto turn = std::polar(1.0, 2.0 * pi * phase * static_cast<double>(n));
      for (std::size_t f = 0; f < speeds.size(); ++f) speeds[f] += (harmonic[n][f] * turn).real();
    }
    pulse.velocities.push_back(along(-section.normal(), speeds));
    const double peak = std::abs(pulse.flows.back()) / section.area() * 2.0 * radius / nu;
    pulse.peak_reynolds = std::max(pulse.peak_reynolds, peak);
  }
  return pulse;
}

FourierSeries scaled_series(const FlowOptions& options, FlowSetup& setup) {
  const Waveform waveform = options.waveform ? *options.waveform : typical_waveform(options.period);
  FourierSeries series = fourier_series(waveform, harmonics);
  const double off = deviation(series, waveform);
  if (off > greatest_deviation) {
    setup.warnings.push_back(fmt::format(
        "the waveform has edges that its first {} harmonics miss by up to {:.0f} % of its range: "
        "the inlet's flow is smoother than the table",
        harmonics, 100.0 * off));
  }
  const double factor = setup.flow_rate / series.coefficients[0].real();
  for (std::complex<double>& c : series.coefficients) c *= factor;
  return series;
}

void warn(FlowSetup& setup) {
  const double peak = setup.pulse ? setup.pulse->peak_reynolds : setup.reynolds;
  if (peak > laminar_reynolds) {
    setup.warnings.push_back(fmt::format(
        "the Reynolds number at the inlet is up to {:.0f}: the case is set up as laminar, with no "
        "turbulence model",
        peak));
  }
  if (setup.pulse && setup.blood.model == FluidModel::carreau) {
    setup.warnings.emplace_back(
        "the inlet's profile is that of a Newtonian fluid with the viscosity at infinite shear "
        "rate; the Carreau fluid develops its own behind it");
  }
}

}  // namespace

FlowSetup set_up_flow(const CellMesh& mesh, const std::vector<LumenOpening>& openings,
                      const FlowOptions& options, double metres_per_unit) {
  check_options(options);
  FlowSetup setup;
  setup.blood = options.blood;
  setup.inlet = inlet_of(openings).patch;
  setup.outlets = outlets_of(openings, options.split, metres_per_unit);
  std::vector<Vec3> points = mesh.points;
  for (Vec3& p : points) p *= metres_per_unit;
  const CrossSection section(points, faces_of_patch(mesh, setup.inlet));
  setup.inlet_area = section.area();
  setup.inlet_diameter = 2.0 * std::sqrt(section.area() / pi);
  setup.flow_rate = mean_flow_rate(options, setup);
  setup.velocity = setup.flow_rate / setup.inlet_area;
  const double nu = options.blood.kinematic_viscosity();
  setup.reynolds = setup.velocity * setup.inlet_diameter / nu;
  setup.inlet_face_centers = section.face_centers();
  std::vector<double> speeds = section.steady();
  for (double& speed : speeds) speed *= setup.velocity;
  setup.inlet_velocities = along(-section.normal(), speeds);
  if (options.pulsatile)
    setup.pulse = pulse_of(section, scaled_series(options, setup), nu, options.cycles);
  warn(setup);
  return setup;
}

}  // namespace hexwall
