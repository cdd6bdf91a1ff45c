#include "quality_command.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/errors.h"
#include "exporters/output_file.h"
#include "inspect/conditions.h"
#include "inspect/mesh_quality.h"
#include "inspect/read_mesh.h"
#include "report.h"

namespace hexwall {
namespace {

using Json = nlohmann::ordered_json;

constexpr auto condition_holds = static_cast<ExitCode>(condition_holds_exit_code);
constexpr int bar_width = 40;

struct QualityOptions {
  std::string mesh;
  std::string output;                ///< JSON file; empty: none
  bool json = false;                 ///< print JSON instead of words
  std::vector<std::string> fail_if;  ///< see `Condition`
  std::size_t worst = 5;
};

// A bar with a resolution of an eighth of a letter.
std::string bar(std::size_t count, std::size_t greatest) {
  constexpr std::array<const char*, 8> parts{"", "▏", "▎", "▍", "▌", "▋", "▊", "▉"};
  const double length = static_cast<double>(bar_width) * static_cast<double>(count) /
                        static_cast<double>(std::max<std::size_t>(greatest, 1));
  auto eighths = static_cast<int>(std::lround(8.0 * length));
  if (count > 0) eighths = std::max(eighths, 1);
  std::string text;
  for (; eighths >= 8; eighths -= 8) text += "█";
  return text + parts[static_cast<std::size_t>(eighths)];
}

// Bins without anything before the first and behind the last one are left out.
void print_histogram(const std::string& title, const Distribution& d) {
  const Histogram& h = d.histogram;
  if (d.count == 0 || h.width == 0.0) return;
  fmt::print("\n  {}\n", title);
  std::size_t first = 0;
  std::size_t last = h.counts.size() - 1;
  while (first < last && h.counts[first] == 0) ++first;
  while (last > first && h.counts[last] == 0) --last;
  const std::size_t greatest = *std::max_element(h.counts.begin(), h.counts.end());
  for (std::size_t i = first; i <= last; ++i) {
    const double low = h.low + static_cast<double>(i) * h.width;
    // What lies beyond the bins counts in the first and the last one.
    const std::string sign = i == 0 && d.min < low ? "< " : "";
    const double shown = sign.empty() ? low : low + h.width;
    fmt::print("  {:>12} {:>9}  {}\n", fmt::format("{}{:.4g}", sign, shown), h.counts[i],
               bar(h.counts[i], greatest));
  }
}

void print_row(const std::string& name, const Distribution& d) {
  fmt::print("  {:<26} {:>10.4g} {:>10.4g} {:>10.4g} {:>10.4g} {:>10.4g} {:>10.4g}\n", name, d.min,
             d.quantiles[0], d.quantiles[2], d.quantiles[4], d.max, d.mean);
}

void print_metrics(const MeshQuality& q) {
  fmt::print("\n  {:<26} {:>10} {:>10} {:>10} {:>10} {:>10} {:>10}\n", "", "min", "1 %", "median",
             "99 %", "max", "mean");
  for (const MetricResult& result : q.metrics) {
    print_row(std::string(result.metric.name), result.all);
    if (result.by_shape.size() < 2) continue;
    for (const auto& [shape, distribution] : result.by_shape) {
      print_row("  " + std::string(name(shape)), distribution);
    }
  }
  print_row("corner angle", q.corner_angle);
  print_row("log edge ratio", q.log_edge_ratio);
}

void print_foam(const MeshQuality& q) {
  if (q.foam.empty()) return;
  fmt::print("\n  {:<26} {:>10} {:>10} {:>10} {:>12} {:>9}  {}\n", "OpenFOAM", "min", "mean", "max",
             "threshold", "beyond", "set");
  for (const FoamResult& result : q.foam) {
    const FoamMetric& m = result.metric;
    if (m.count == 0) continue;
    fmt::print("  {:<26} {:>10.4g} {:>10.4g} {:>10.4g} {:>12} {:>9}  {}\n", m.name, m.min, m.mean,
               m.max, fmt::format("{} {:.4g}", m.low_is_bad ? "<" : ">", m.threshold),
               m.beyond.size(), m.set);
  }
}

void print_places(const std::string& name, const std::vector<WorstPlace>& places) {
  for (const WorstPlace& p : places) {
    fmt::print("  {:<26} {:>10.4g}  {} {} at ({:.6g}, {:.6g}, {:.6g})\n", name, p.value, p.what,
               p.label, p.at.x(), p.at.y(), p.at.z());
  }
}

void print_worst(const MeshQuality& q) {
  fmt::print("\n  worst\n");
  for (const MetricResult& result : q.metrics) {
    const auto& name = result.metric.name;
    if (name == "scaled_jacobian" || name == "skew" || name == "max_angle") {
      print_places(std::string(name), result.worst);
    }
  }
  for (const FoamResult& result : q.foam) {
    if (!result.metric.beyond.empty()) print_places(result.metric.name, result.worst);
  }
}

void print_words(const QualityOptions& command, const MeshQuality& q) {
  fmt::print("{}\n  {:<10} {}\n", command.mesh, "points", q.points);
  for (std::size_t s = 0; s < q.count.size(); ++s) {
    const auto shape = static_cast<ElementShape>(s);
    if (q.count[s] > 0) fmt::print("  {:<10} {}\n", name(shape), q.count[s]);
  }
  for (const std::string& note : q.notes) fmt::print("  {:<10} {}\n", "note", note);
  print_metrics(q);
  print_foam(q);
  if (command.worst > 0) print_worst(q);
  for (const MetricResult& result : q.metrics) {
    if (result.metric.name == "scaled_jacobian") print_histogram("scaled Jacobian", result.all);
  }
  print_histogram("corner angles, degrees", q.corner_angle);
  print_histogram("log of the ratio of edges that meet", q.log_edge_ratio);
}

struct Verdict {
  std::string condition;
  bool holds;
};

std::vector<Verdict> judge(const QualityOptions& command, const MeshQuality& q) {
  const Figures figures = figures_of(q);
  std::vector<Verdict> verdicts;
  for (const std::string& text : command.fail_if) {
    verdicts.push_back({text, holds(parse_condition(text), figures)});
  }
  return verdicts;
}

Json document(const QualityOptions& command, const MeshQuality& q,
              const std::vector<Verdict>& verdicts) {
  Json json = {{"quality_version", 1}, {"hexwall_version", version()}, {"file", command.mesh}};
  json.update(to_json(q));
  json["conditions"] = Json::array();
  for (const Verdict& v : verdicts) {
    json["conditions"].push_back({{"fail_if", v.condition}, {"holds", v.holds}});
  }
  return json;
}

ExitCode run_quality(const QualityOptions& command) {
  for (const std::string& text : command.fail_if) parse_condition(text);
  const MeshQuality q = mesh_quality(read_mesh(command.mesh), command.worst);
  const std::vector<Verdict> verdicts = judge(command, q);
  const std::string json = document(command, q, verdicts).dump(2) + "\n";
  if (!command.output.empty()) write_output_file(command.output, json);
  if (command.json) {
    fmt::print("{}", json);
  } else {
    print_words(command, q);
  }
  bool any = false;
  for (const Verdict& v : verdicts) {
    if (!v.holds) continue;
    fmt::print(stderr, "hexwall: {}: {} holds\n", command.mesh, v.condition);
    any = true;
  }
  return any ? condition_holds : ExitCode::success;
}

}  // namespace

Command add_quality(CLI::App& app) {
  const auto command = std::make_shared<QualityOptions>();
  CLI::App* quality = app.add_subcommand(
      "quality", "Measure a mesh of any tool: figures, histograms, the worst cells");
  quality
      ->add_option("MESH", command->mesh,
                   ".vtu, .vtp, .vtk, .msh, .inp, .stl, .obj, .ply, .off, or a folder with an "
                   "OpenFOAM mesh")
      ->required();
  quality->add_option("-o,--output", command->output, "JSON file with all figures and histograms");
  quality->add_flag("--json", command->json, "Print JSON instead of words");
  quality
      ->add_option("--fail-if", command->fail_if,
                   "Exit with code 8 if this holds: NAME OP NUMBER, such as "
                   "min_scaled_jacobian<0.2; may be given several times")
      ->expected(1)
      ->take_all();
  quality->add_option("--worst", command->worst, "How many of the worst places are listed")
      ->capture_default_str();
  return {quality, [command] { return run_quality(*command); }};
}

}  // namespace hexwall
