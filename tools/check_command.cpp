#include "check_command.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "exporters/output_file.h"
#include "exporters/vtk_files.h"
#include "output_folder.h"
#include "report.h"
#include "surface/check.h"
#include "surface/read.h"

namespace hexwall {
namespace {

using Json = nlohmann::ordered_json;

/// What is known of a surface in the end.
struct Diagnosis {
  ReadResult read;
  std::vector<Problem> problems;  ///< of the surface as it comes
  std::optional<PrepareResult> prepared;
  ExitCode verdict = ExitCode::success;
  std::string reason;              ///< of the refusal
  std::vector<std::string> notes;  ///< what was done, before a refusal as well
};

// What is done to a surface before it is refused.
std::vector<std::string> notes_before_refusal(const ReadResult& read,
                                              const PrepareOptions& options) {
  try {
    bool is_free_of_intersections = false;
    return repair_and_open(read, options, is_free_of_intersections).notes;
  } catch (const Error&) {
    return read.notes;
  }
}

Diagnosis diagnose(ReadResult read, const PrepareOptions& options) {
  Diagnosis d;
  d.read = std::move(read);
  d.problems = find_problems(d.read.surface);
  try {
    d.prepared = prepare_surface(d.read, options);
    d.notes = d.prepared->notes;
  } catch (const TopologyError& error) {
    d.verdict = error.code();
    d.reason = error.what();
  } catch (const GeometryError& error) {
    d.verdict = error.code();
    d.reason = error.what();
  }
  if (!d.prepared) d.notes = notes_before_refusal(d.read, options);
  return d;
}

Json place_json(const Vec3& p) {
  return Json::array({p.x(), p.y(), p.z()});
}

Json openings_json(const std::vector<NamedPlace>& openings) {
  Json list = Json::array();
  for (const NamedPlace& opening : openings) {
    list.push_back({{"name", opening.name}, {"center", place_json(opening.at)}});
  }
  return list;
}

Json problems_json(const std::vector<Problem>& problems) {
  Json list = Json::array();
  for (const Problem& problem : problems) {
    Json places = Json::array();
    for (const Vec3& p : problem.places) places.push_back(place_json(p));
    list.push_back(
        {{"kind", problem.kind}, {"message", problem.message}, {"places", std::move(places)}});
  }
  return list;
}

Json to_json(const CheckOptions& command, const Diagnosis& d) {
  Json json = {{"hexwall_version", version()},
               {"input",
                {{"file", command.input.surface},
                 {"vertices", d.read.surface.points.size()},
                 {"faces", d.read.surface.triangles.size()},
                 {"notes", d.read.notes}}},
               {"problems", problems_json(d.problems)},
               {"meshable", d.verdict == ExitCode::success},
               {"exit_code", static_cast<int>(d.verdict)},
               {"reason", d.reason}};
  json["notes"] = d.notes;
  if (!d.prepared) return json;
  json["preparation"] = preparation_json(*d.prepared);
  json["openings"] = openings_json(d.prepared->openings);
  json["warnings"] = d.prepared->warnings;
  return json;
}

void print_words(const CheckOptions& command, const Diagnosis& d) {
  const auto line = [](const std::string& label, const std::string& text) {
    fmt::print("  {:<10} {}\n", label, text);
  };
  fmt::print("{}\n", command.input.surface);
  line("read", fmt::format("{} vertices, {} triangles", d.read.surface.points.size(),
                           d.read.surface.triangles.size()));
  for (const Problem& problem : d.problems) line("problem", problem.message);
  if (d.problems.empty()) line("problem", "none as it comes");
  for (const std::string& note : d.notes) line("done", note);
  if (!d.prepared) {
    line("verdict", "refused: " + d.reason);
    return;
  }
  if (d.prepared->moved > 0.0) {
    line("moved",
         fmt::format("by repairs: {:.3g} {} at most", d.prepared->moved, command.input.units));
  }
  for (const std::string& warning : d.prepared->warnings) line("warning", warning);
  for (const NamedPlace& opening : d.prepared->openings) {
    line("opening", fmt::format("{} at ({:.6g}, {:.6g}, {:.6g})", opening.name, opening.at.x(),
                                opening.at.y(), opening.at.z()));
  }
  line("verdict", fmt::format("can be meshed: {} vertices, {} triangles, {} openings",
                              d.prepared->surface.points.size(),
                              d.prepared->surface.triangles.size(), d.prepared->openings.size()));
}

// A vertex for each place of a problem or repair.
PolyData places_data(const Diagnosis& d) {
  PolyData data;
  std::vector<int> kinds;
  FieldStrings names{"kind_names", {}};
  const auto add = [&](const std::string& kind, const std::vector<Vec3>& places) {
    const auto known = std::find(names.values.begin(), names.values.end(), kind);
    const auto number = static_cast<int>(known - names.values.begin());
    if (known == names.values.end()) names.values.push_back(kind);
    for (const Vec3& p : places) {
      data.vertices.add(std::array{static_cast<int>(data.points.size())});
      data.points.push_back(p);
      kinds.push_back(number);
    }
  };
  for (const Problem& problem : d.problems) add(problem.kind, problem.places);
  if (d.prepared) {
    for (const RepairAction& action : d.prepared->repairs) {
      add("repair_" + std::string(name(action.step)), action.places);
    }
  }
  data.cell_arrays.push_back({"kind", 1, std::move(kinds)});
  data.strings.push_back(std::move(names));
  return data;
}

PolyData prepared_data(const PrepareResult& prepared) {
  PolyData data;
  data.points = prepared.surface.points;
  data.polygons.reserve(prepared.surface.triangles.size(), 3);
  for (const auto& triangle : prepared.surface.triangles) data.polygons.add(triangle);
  data.cell_arrays.push_back({"extension", 1, prepared.extension});
  return data;
}

ExitCode run_check(const CheckOptions& command) {
  const PrepareOptions preparation = prepare_options(command.input);
  const Diagnosis d = diagnose(read_surface(command.input.surface), preparation);
  const std::string json = to_json(command, d).dump(2) + "\n";
  if (!command.output.empty()) {
    OutputFolder folder(command.output);
    write_output_file(folder.staging() / "check.json", json);
    write_vtp(folder.staging() / "problems.vtp", places_data(d));
    if (d.prepared) write_vtp(folder.staging() / "prepared.vtp", prepared_data(*d.prepared));
    folder.commit();
  }
  if (command.json) {
    fmt::print("{}", json);
  } else {
    print_words(command, d);
  }
  return d.verdict;
}

}  // namespace

void add_check_options(CLI::App& check, CheckOptions& command) {
  add_input_options(check, command.input);
  check.add_option("-o,--output", command.output,
                   "Folder for check.json, problems.vtp (a point at each problem) and "
                   "prepared.vtp (the surface that would be meshed)");
  check.add_flag("--json", command.json, "Print JSON instead of words");
}

nlohmann::ordered_json check_report(const CheckOptions& options, const PrepareOptions& preparation,
                                    ReadResult read) {
  return to_json(options, diagnose(std::move(read), preparation));
}

Command add_check(CLI::App& app) {
  CLI::App* check = app.add_subcommand(
      "check", "Say what is wrong with a surface, and what would be done about it");
  const auto command = std::make_shared<CheckOptions>();
  add_check_options(*check, *command);
  return {check, [command] { return run_check(*command); }};
}

}  // namespace hexwall
