#include "compare_command.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/forked.h"
#include "exporters/output_file.h"
#include "lumen_command.h"
#include "output_folder.h"

namespace hexwall {
namespace {

using Json = nlohmann::ordered_json;

// No mesh of a comparison should take longer.
constexpr double most_seconds = 3600.0;

struct CompareOptions {
  LumenCommandOptions lumen;
  std::vector<double> factors{2.0, 1.4, 1.0};
};

/// A column of the table: what it is, its key in JSON and CSV, its format in the terminal.
struct Column {
  const char* title;
  const char* key;
  const char* format;
};

constexpr std::array<Column, 13> columns{{
    {"size", "size", "{:.4g}"},
    {"cells", "cells", "{:.0f}"},
    {"points", "points", "{:.0f}"},
    {"non-orth", "non_orthogonality_deg", "{:.1f}"},
    {"mean", "mean_non_orthogonality_deg", "{:.1f}"},
    {">70", "faces_above_70", "{:.0f}"},
    {"skewness", "skewness", "{:.2f}"},
    {"aspect", "aspect_ratio", "{:.1f}"},
    {"vol ratio", "volume_ratio", "{:.1f}"},
    {"to wall", "wall_distance", "{:.4g}"},
    {"volume", "volume", "{:.6g}"},
    {"seconds", "seconds", "{:.1f}"},
    {"MB", "memory_bytes", "{:.0f}"},
}};

Json row_of(const LumenRun& run) {
  const LumenResult& r = run.lumen;
  const CellQuality& q = r.quality.front();
  return {{"size", *run.surface.result.options.size},
          {"cells", r.mesh.cells()},
          {"hexahedra", r.counts.hexes},
          {"pyramids", r.counts.pyramids},
          {"tetrahedra", r.counts.tets},
          {"points", r.mesh.points.size()},
          {"non_orthogonality_deg", q.non_orthogonality.value},
          {"mean_non_orthogonality_deg", q.mean_non_orthogonality},
          {"faces_above_70", q.faces_above_70},
          {"skewness", q.skewness.value},
          {"aspect_ratio", q.aspect_ratio.value},
          {"volume_ratio", q.volume_ratio.value},
          {"wall_distance", mean_wall_distance(r.mesh)},
          {"volume", q.volume},
          {"tetgen_seconds", r.tetgen_seconds}};
}

// Makes a mesh in a process of its own, so that its memory is its own too.
Json measure(const LumenCommandOptions& options) {
  const auto work = [&]() -> std::string {
    try {
      const auto limit = limit_threads(options.surface);
      return row_of(run_lumen(options)).dump();
    } catch (const Error& error) {
      return Json{{"error", error.what()}, {"exit_code", static_cast<int>(error.code())}}.dump();
    }
  };
  const ForkedResult run = run_forked(work, most_seconds);
  Json row = {{"mesh", options.mesh}};
  if (run.finished) {
    row.update(Json::parse(run.bytes));
  } else {
    row["error"] = run.timed_out ? "it took too long" : "it crashed: " + run.output;
    row["exit_code"] = static_cast<int>(ExitCode::internal);
  }
  row["seconds"] = run.seconds;
  row["memory_bytes"] = run.memory_bytes;
  return row;
}

std::string cell_of(const Json& row, const Column& column) {
  if (!row.contains(column.key)) return "-";
  double value = row[column.key].get<double>();
  if (std::string_view(column.key) == "memory_bytes") value /= 1e6;
  return fmt::format(fmt::runtime(column.format), value);
}

void print_table(const Json& rows) {
  fmt::print("  {:<8}", "mesh");
  for (const Column& column : columns) fmt::print("{:>10}", column.title);
  fmt::print("\n");
  for (const Json& row : rows) {
    fmt::print("  {:<8}", row["mesh"].get<std::string>());
    for (const Column& column : columns) fmt::print("{:>10}", cell_of(row, column));
    fmt::print("\n");
    if (row.contains("error")) fmt::print("    {}\n", row["error"].get<std::string>());
  }
}

std::string csv_of(const Json& rows) {
  std::string text = "mesh";
  for (const Column& column : columns) text += fmt::format(",{}", column.key);
  text += '\n';
  for (const Json& row : rows) {
    text += row["mesh"].get<std::string>();
    for (const Column& column : columns) {
      text += ',';
      if (row.contains(column.key)) text += row[column.key].dump();
    }
    text += '\n';
  }
  return text;
}

void check_options(const CompareOptions& c) {
  if (c.lumen.surface.layers.side != "in") {
    throw UsageError("hexwall compare is about the lumen alone: leave out --side");
  }
  for (const double factor : c.factors) {
    if (!(factor > 0.0)) throw UsageError("--factors must be positive");
  }
}

ExitCode run(const CompareOptions& c) {
  check_options(c);
  OutputFolder folder(c.lumen.surface.output);
  LumenCommandOptions options = c.lumen;
  options.surface.quiet = true;
  Json rows = Json::array();
  options.mesh = "hybrid";
  rows.push_back(measure(options));
  if (rows[0].contains("error")) {
    throw Error(static_cast<ExitCode>(rows[0]["exit_code"].get<int>()), rows[0]["error"]);
  }
  options.mesh = "tet";
  for (const double factor : c.factors) {
    options.surface.size = factor * rows[0]["size"].get<double>();
    rows.push_back(measure(options));
  }
  const Json report = {{"hexwall_version", version()},
                       {"input", c.lumen.surface.input.surface},
                       {"units", c.lumen.surface.input.units},
                       {"meshes", rows}};
  write_output_file(folder.staging() / "compare.json", report.dump(2) + "\n");
  write_output_file(folder.staging() / "compare.csv", csv_of(rows));
  folder.commit();
  if (c.lumen.surface.quiet) return ExitCode::success;
  print_table(rows);
  fmt::print("  {:<8}{}\n", "results", folder.path().string());
  return ExitCode::success;
}

}  // namespace

Command add_compare(CLI::App& app) {
  CLI::App* compare = app.add_subcommand(
      "compare", "Compare the hybrid mesh of a lumen with tetrahedra of several sizes");
  const auto c = std::make_shared<CompareOptions>();
  add_lumen_options(*compare, c->lumen);
  compare->remove_option(compare->get_option("--mesh"));
  compare
      ->add_option("--factors", c->factors,
                   "Sizes of the meshes of tetrahedra, relative to that of the hybrid one")
      ->delimiter(',')
      ->capture_default_str();
  return {compare, [c] { return run(*c); }};
}

}  // namespace hexwall
