#include "input_options.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "core/errors.h"
#include "surface/cut_planes.h"
#include "surface/transfer.h"

namespace hexwall {
namespace {

const std::map<std::string, double> units_in_metres{
    {"mm", 1e-3}, {"cm", 1e-2}, {"m", 1.0}, {"um", 1e-6}};

std::string step_names() {
  std::string names;
  for (const RepairStep step : all_repair_steps()) {
    names += (names.empty() ? "" : ", ") + std::string(name(step));
  }
  return names;
}

RepairOptions repair_options(const InputOptions& options) {
  RepairOptions repair;
  if (!options.repair.empty()) {
    repair.steps.clear();
    for (const std::string& step : options.repair) {
      repair.steps.push_back(repair_step_from_name(step));
    }
  }
  if (options.no_repair) repair.steps.clear();
  repair.tolerance = options.tolerance;
  repair.pinhole_length = options.pinholes;
  if (options.remesh == "auto") return repair;
  const auto is_remesh = [](RepairStep step) { return step == RepairStep::remesh; };
  repair.steps.erase(std::remove_if(repair.steps.begin(), repair.steps.end(), is_remesh),
                     repair.steps.end());
  if (options.remesh == "off") return repair;
  double edge = 0.0;
  const char* end = options.remesh.data() + options.remesh.size();
  const auto [rest, error] = std::from_chars(options.remesh.data(), end, edge);
  if (error != std::errc() || rest != end) {
    throw UsageError(
        fmt::format("--remesh is auto, off or an edge length, not '{}'", options.remesh));
  }
  repair.steps.push_back(RepairStep::remesh);
  repair.remesh_edge = edge;
  return repair;
}

}  // namespace

void add_input_options(CLI::App& command, InputOptions& o) {
  command.add_option("SURFACE", o.surface, "Surface of the vessel: STL, OBJ, PLY, OFF, VTP, VTK")
      ->required();
  command.add_option("--units", o.units, "Unit of the input")
      ->check(CLI::IsMember({"mm", "cm", "m", "um"}))
      ->capture_default_str();
  const std::string group = "Preparation of the surface";
  auto* repair =
      command
          .add_option("--repair", o.repair,
                      "Repair steps to run, separated by commas: " + step_names() + " [all]")
          ->delimiter(',')
          ->group(group);
  command.add_flag("--no-repair", o.no_repair, "Take the surface as it is")
      ->excludes(repair)
      ->group(group);
  command
      .add_option("--tolerance", o.tolerance,
                  "Greatest distance that repairs may move the surface [half the mean edge]")
      ->group(group);
  command
      .add_option("--pinholes", o.pinholes,
                  "Fill holes of a shorter perimeter [by the size of the openings]")
      ->group(group);
  command
      .add_option(
          "--remesh", o.remesh,
          "Remesh the surface: auto (if its triangles are hopeless), off, or an edge length")
      ->capture_default_str()
      ->group(group);
  command.add_option("--open", o.open, "Open the flat caps of a closed surface")
      ->check(CLI::IsMember({"auto", "off"}))
      ->capture_default_str()
      ->group(group);
  command
      .add_option("--cap-array", o.cap_array, "Cell array of the input that tells caps from wall")
      ->group(group);
  command
      .add_option("--open-at", o.open_at,
                  "File of planes that cut off ends: x y z nx ny nz [radius] [name] on each line, "
                  "the normal towards what is cut off")
      ->group(group);
  command
      .add_option("--names", o.names,
                  "JSON file of names of openings: [{\"name\": \"inlet\", \"at\": [x, y, z]}, ...]")
      ->group(group);
  command
      .add_option("--extend", o.extend,
                  "Add straight flow extensions of as many radii to each opening")
      ->group(group);
}

PrepareOptions prepare_options(const InputOptions& options) {
  if (!(options.extend >= 0.0 && std::isfinite(options.extend))) {
    throw UsageError(
        fmt::format("--extend is a number of radii, 0 or more, not {}", options.extend));
  }
  PrepareOptions prepare;
  prepare.repair = repair_options(options);
  prepare.open.automatic = options.open == "auto";
  if (!options.cap_array.empty()) prepare.open.cap_array = options.cap_array;
  if (!options.open_at.empty()) prepare.open.cuts = read_cut_planes(options.open_at);
  if (!options.names.empty()) prepare.names = read_names(options.names);
  prepare.extend = options.extend;
  prepare.metres_per_unit = metres_per_unit(options.units);
  return prepare;
}

std::vector<double> point_values(const ReadResult& read, const std::string& array,
                                 const TriangleSurface& prepared) {
  std::string known;
  for (const SurfaceArray& candidate : read.point_arrays) {
    if (candidate.name == array && candidate.components == 1) {
      return transfer_point_array(candidate, read.surface, prepared);
    }
    known += (known.empty() ? "" : ", ") + candidate.name;
  }
  throw UsageError(fmt::format("the input has no scalar point array '{}'. It has: {}", array,
                               known.empty() ? "none" : known));
}

double metres_per_unit(const std::string& units) {
  return units_in_metres.at(units);
}

}  // namespace hexwall
