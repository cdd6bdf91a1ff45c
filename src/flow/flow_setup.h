#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "flow/blood.h"
#include "flow/waveform.h"
#include "hex/cell_mesh.h"
#include "lumen/lumen_opening.h"

namespace hexwall {

/// What flows. At most one of `reynolds` and `flow_rate` is given; without any Re is 300, or, with
/// a waveform, the flow rate is the waveform's.
struct FlowOptions {
  std::optional<double> reynolds;       ///< at the inlet; of the mean over the cycle if pulsatile
  std::optional<double> flow_rate;      ///< m³/s; the same
  std::map<std::string, double> split;  ///< share of each outlet; empty: by Murray's law
  Blood blood;
  bool pulsatile = false;
  std::optional<Waveform> waveform;  ///< flows in m³/s; without: `typical_waveform`
  double period = 1.0;               ///< s, of `typical_waveform`
  int cycles = 3;                    ///< of which the last is averaged
};

struct FlowOutlet {
  std::string patch;
  double area = 0.0;    ///< m²
  double radius = 0.0;  ///< m, of the circle of equal area
  double share = 0.0;   ///< of the flow; the shares add up to 1
  bool fixes_pressure =
      false;  ///< p = 0, for the one with the largest share; the others fix their flow
};

/// One cycle of a pulse. Velocities are Womersley's on the inlet's own faces.
struct Pulse {
  double period = 0.0;  ///< s
  int cycles = 0;
  double womersley = 0.0;                     ///< R sqrt(ω/ν) at the inlet
  double peak_reynolds = 0.0;                 ///< of the greatest |flow rate|
  std::vector<double> times;                  ///< s, from 0 to the period
  std::vector<double> flows;                  ///< m³/s at `times`
  std::vector<std::vector<Vec3>> velocities;  ///< m/s at `times`, of each face of the inlet
};

/// Boundary values of a flow, in SI units.
struct FlowSetup {
  Blood blood;
  std::string inlet;
  double inlet_area = 0.0;               ///< m²
  double inlet_diameter = 0.0;           ///< m, 2 sqrt(A/π)
  double flow_rate = 0.0;                ///< m³/s; mean over the cycle
  double velocity = 0.0;                 ///< m/s, `flow_rate` over `inlet_area`
  double reynolds = 0.0;                 ///< `velocity` · `inlet_diameter` / ν
  std::vector<Vec3> inlet_face_centers;  ///< m
  std::vector<Vec3> inlet_velocities;    ///< m/s, developed flow of `flow_rate` on each face
  std::vector<FlowOutlet> outlets;       ///< in the order of the openings
  std::optional<Pulse> pulse;
  std::vector<std::string> warnings;
};

/// Boundary values for the flow through `mesh`.
/// Re is by the diameter of the circle that has the inlet's area, and by the viscosity at infinite
/// shear rate. Shares of the outlets are proportional to the cube of the radius of the circle of
/// equal area (Murray, PNAS 12:207, 1926), or as given.
/// \param openings of `mesh`; exactly one is an inlet
/// \param metres_per_unit of the mesh's coordinates
/// \throws UsageError for options out of range, shares that name no outlet or not all outlets, and
/// if there are not exactly one inlet and at least one outlet.
FlowSetup set_up_flow(const CellMesh& mesh, const std::vector<LumenOpening>& openings,
                      const FlowOptions& options, double metres_per_unit);

}  // namespace hexwall
