#include "shear_command.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "exporters/output_file.h"
#include "exporters/vtk_files.h"
#include "flow/read_run.h"
#include "flow/wall_shear.h"
#include "output_folder.h"
#include "report.h"

namespace hexwall {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct ShearOptions {
  std::string case_dir;
  std::string output;
  std::optional<double> density;
  double low = 0.4;
  bool json = false;
};

/// What of the case is not in OpenFOAM's own files.
struct CaseFacts {
  double density = 0.0;
  double metres_per_unit = 1.0;
};

/// From the report that `hexwall case` leaves in the case, or from the options.
CaseFacts facts_of(const ShearOptions& c) {
  CaseFacts facts;
  const fs::path path = fs::path(c.case_dir) / "report.json";
  std::ifstream file(path);
  if (file) {
    try {
      const Json flow = Json::parse(file).at("flow");
      facts.density = flow.at("fluid").at("density");
      facts.metres_per_unit = flow.at("metres_per_unit");
    } catch (const nlohmann::json::exception& error) {
      throw ReadError(
          fmt::format("'{}' is no report of hexwall case: {}", path.string(), error.what()));
    }
  }
  if (c.density) facts.density = *c.density;
  if (!(std::isfinite(facts.density) && facts.density > 0.0)) {
    throw UsageError(fmt::format(
        "the density is needed: there is no report of hexwall case in '{}', so give --density, a "
        "positive number of kg/m³",
        c.case_dir));
  }
  return facts;
}

/// One row of the table: a quantity on a wall.
struct Row {
  std::string wall;
  std::string quantity;
  std::string unit;
  AreaStatistics statistics;
};

struct Result {
  double time = 0.0;
  std::vector<RunWall> walls;
  std::vector<WallShear> shear;  ///< of each wall
  std::vector<Row> rows;
};

void add_rows(const RunWall& wall, const WallShear& shear, std::vector<Row>& rows) {
  const auto add = [&](const char* quantity, const char* unit, const std::vector<double>& values) {
    if (!values.empty())
      rows.push_back({wall.name, quantity, unit, area_statistics(values, wall.areas)});
  };
  add("wss", "Pa", shear.magnitude);
  add("tawss", "Pa", shear.tawss);
  add("osi", "", shear.osi);
  add("rrt", "1/Pa", shear.rrt);
}

Result evaluate(const ShearOptions& c, const CaseFacts& facts) {
  Result result;
  RunWalls run = read_run(c.case_dir);
  result.time = run.time;
  result.walls = std::move(run.walls);
  for (const RunWall& wall : result.walls) {
    result.shear.push_back(wall_shear(wall, facts.density));
    add_rows(wall, result.shear.back(), result.rows);
  }
  return result;
}

/// Share of a wall where the stress, of a pulse its mean over time, is low.
double low_area_fraction(const RunWall& wall, const WallShear& shear, double low) {
  return area_fraction_below(shear.tawss.empty() ? shear.magnitude : shear.tawss, wall.areas, low);
}

Json to_json(const ShearOptions& c, const CaseFacts& facts, const Result& result) {
  Json walls = Json::array();
  for (std::size_t i = 0; i < result.walls.size(); ++i) {
    const RunWall& wall = result.walls[i];
    double area = 0.0;
    for (const double of_face : wall.areas) area += of_face;
    Json json = {{"patch", wall.name},
                 {"area", area},
                 {"low_area_fraction", low_area_fraction(wall, result.shear[i], c.low)}};
    for (const Row& row : result.rows) {
      if (row.wall != wall.name) continue;
      Json& of_row = json[row.quantity];
      of_row = {{"mean", row.statistics.mean},
                {"min", row.statistics.least},
                {"max", row.statistics.greatest}};
      for (std::size_t k = 0; k < row.statistics.percentiles.size(); ++k)
        of_row[fmt::format("p{}", kPercentiles[k])] = row.statistics.percentiles[k];
    }
    walls.push_back(std::move(json));
  }
  return {{"hexwall_version", version()}, {"case", c.case_dir},     {"time", result.time},
          {"density", facts.density},     {"low_threshold", c.low}, {"walls", std::move(walls)}};
}

void print_table(const ShearOptions& c, const Result& result) {
  fmt::print("{}, time {:.10g}\n", c.case_dir, result.time);
  fmt::print("  {:<16} {:<6} {:<5} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9}\n", "wall", "", "", "mean",
             "min", "5 %", "50 %", "95 %", "max");
  for (const Row& row : result.rows) {
    const AreaStatistics& s = row.statistics;
    fmt::print("  {:<16} {:<6} {:<5} {:>9.4g} {:>9.4g} {:>9.4g} {:>9.4g} {:>9.4g} {:>9.4g}\n",
               row.wall, row.quantity, row.unit, s.mean, s.least, s.percentiles[1],
               s.percentiles[3], s.percentiles[5], s.greatest);
  }
  for (std::size_t i = 0; i < result.walls.size(); ++i) {
    fmt::print("  {}: {:.1f} % of the area below {} Pa\n", result.walls[i].name,
               100.0 * low_area_fraction(result.walls[i], result.shear[i], c.low), c.low);
  }
}

/// Values of all walls, one after the other.
template <typename Get>
std::vector<double> joined(const Result& result, const Get& get) {
  std::vector<double> values;
  for (const WallShear& shear : result.shear) {
    const std::vector<double>& part = get(shear);
    values.insert(values.end(), part.begin(), part.end());
  }
  return values;
}

void add_arrays(const Result& result, std::size_t faces, PolyData& data) {
  std::vector<double> vectors;
  for (const WallShear& shear : result.shear)
    for (const Vec3& stress : shear.stress)
      for (const double x : {stress.x(), stress.y(), stress.z()}) vectors.push_back(x);
  data.cell_arrays.push_back({"wss_vector", 3, std::move(vectors)});
  const auto add = [&](const char* name, const auto& get) {
    std::vector<double> values = joined(result, get);
    if (values.size() == faces) data.cell_arrays.push_back({name, 1, std::move(values)});
  };
  add(
      "wss", [](const WallShear& s) -> auto& { return s.magnitude; });
  add(
      "tawss", [](const WallShear& s) -> auto& { return s.tawss; });
  add(
      "osi", [](const WallShear& s) -> auto& { return s.osi; });
  add(
      "rrt", [](const WallShear& s) -> auto& { return s.rrt; });
}

PolyData wall_data(const Result& result, double metres_per_unit) {
  PolyData data;
  std::vector<int> patch;
  FieldStrings names{"patch_names", {}};
  for (const RunWall& wall : result.walls) {
    const int first = static_cast<int>(data.points.size());
    for (const Vec3& p : wall.points) data.points.emplace_back(p / metres_per_unit);
    for (std::vector<int> face : wall.faces) {
      for (int& corner : face) corner += first;
      data.polygons.add(face);
      patch.push_back(static_cast<int>(names.values.size()));
    }
    names.values.push_back(wall.name);
  }
  const std::size_t faces = patch.size();
  data.cell_arrays.push_back({"patch", 1, std::move(patch)});
  data.strings.push_back(std::move(names));
  add_arrays(result, faces, data);
  return data;
}

ExitCode run_shear(const ShearOptions& c) {
  const CaseFacts facts = facts_of(c);
  const Result result = evaluate(c, facts);
  const std::string json = to_json(c, facts, result).dump(2) + "\n";
  if (!c.output.empty()) {
    OutputFolder folder(c.output);
    write_output_file(folder.staging() / "shear.json", json);
    write_vtp(folder.staging() / "wall.vtp", wall_data(result, facts.metres_per_unit));
    folder.commit();
  }
  if (c.json) {
    fmt::print("{}", json);
  } else {
    print_table(c, result);
  }
  return ExitCode::success;
}

}  // namespace

Command add_shear(CLI::App& app) {
  CLI::App* shear = app.add_subcommand(
      "shear", "Wall shear stress of an OpenFOAM case that was run; TAWSS, OSI, RRT of a pulse");
  const auto c = std::make_shared<ShearOptions>();
  shear->add_option("CASE", c->case_dir, "Folder of the case")->required();
  shear->add_option("-o,--output", c->output,
                    "Folder for shear.json and wall.vtp (the walls with all values)");
  shear->add_option("--density", c->density,
                    "Density in kg/m³ [that of hexwall case, from its report.json]");
  shear->add_option("--low", c->low, "Stress in Pa below which area counts as low")
      ->capture_default_str();
  shear->add_flag("--json", c->json, "Print JSON instead of a table");
  return {shear, [c] { return run_shear(*c); }};
}

}  // namespace hexwall
