#include "exporters/report_page.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <vtkBase64Utilities.h>

#include "exporters/svg_plots.h"
#include "inspect/cell_metrics.h"

namespace hexwall {
namespace {

using Json = nlohmann::ordered_json;
using Rows = std::vector<std::pair<std::string, std::string>>;

constexpr std::string_view style = R"css(
:root { color-scheme: light; --line: #d8d8de; --soft: #f5f5f7; --blue: #3c5f96; }
body { font: 15px/1.5 system-ui, "DejaVu Sans", sans-serif; color: #222; margin: 0 auto; padding: 1.5rem;
  max-width: 1180px; }
h1 { font-size: 1.5rem; margin: 0; } h2 { font-size: 1.15rem; margin: 2.2rem 0 .7rem; }
h1 small { font-weight: normal; color: #666; font-size: .9rem; margin-left: .8rem; }
.warnings { border-left: 5px solid #d98c1f; background: #fdf5e6; padding: .6rem 1rem; margin: 1rem 0; }
.fine { border-left: 5px solid #4a9a5a; background: #eef7ef; padding: .6rem 1rem; margin: 1rem 0; }
.warnings ul, .notes { margin: .3rem 0; padding-left: 1.2rem; }
table { border-collapse: collapse; } td, th { padding: .2rem .9rem .2rem 0; text-align: left;
  border-bottom: 1px solid var(--line); vertical-align: top; } td.n, th.n { text-align: right; }
.facts { display: grid; grid-template-columns: repeat(auto-fill, minmax(150px, 1fr)); gap: .7rem; }
.facts div { background: var(--soft); border-radius: 6px; padding: .6rem .8rem; }
.facts b { display: block; font-size: 1.25rem; font-weight: 600; } .facts span { color: #666; font-size: .85rem; }
.grid { display: grid; grid-template-columns: repeat(auto-fill, minmax(340px, 1fr)); gap: 1rem; }
figure { margin: 0; } figure img { width: 100%; border: 1px solid var(--line); border-radius: 6px; }
figcaption { color: #555; font-size: .88rem; }
svg.plot { width: 100%; font-size: 11px; fill: #444; } .grid line.grid { stroke: #e6e6ea; }
line.axis { stroke: #888; } line.mark { stroke: #d98c1f; stroke-dasharray: 4 3; } .bar { fill: #7f9cc6; }
.curve { fill: none; stroke: var(--blue); stroke-width: 1.5; } .dot { fill: var(--blue); }
#view { height: 560px; border: 1px solid var(--line); border-radius: 6px; overflow: hidden; }
.controls { display: flex; flex-wrap: wrap; gap: .5rem 1.2rem; align-items: center; margin: .5rem 0; }
#view-legend { display: flex; flex-wrap: wrap; gap: .4rem; align-items: center; min-height: 1.6rem; }
.ramp { width: 220px; height: 14px; border-radius: 3px; display: inline-block; }
.swatch { width: 14px; height: 14px; border-radius: 3px; display: inline-block; margin-left: .6rem; }
@media print { #view-section { display: none; } }
)css";

std::string base64(const std::string& bytes) {
  std::string text((bytes.size() + 2) / 3 * 4, '\0');
  const auto* from = reinterpret_cast<const unsigned char*>(bytes.data());
  const unsigned long size =
      vtkBase64Utilities::Encode(from, bytes.size(), reinterpret_cast<unsigned char*>(text.data()));
  text.resize(size);
  return text;
}

std::string list_of(const Json& texts) {
  std::string html;
  for (const Json& text : texts) {
    html += "<li>" + html_text(text.get<std::string>()) + "</li>\n";
  }
  return html;
}

std::string section(const std::string& title, const std::string& body, const char* id = nullptr) {
  const std::string attribute = id == nullptr ? "" : fmt::format(" id=\"{}\"", id);
  return fmt::format("<section{}>\n<h2>{}</h2>\n{}</section>\n", attribute, html_text(title), body);
}

std::string table(const Rows& rows) {
  std::string html = "<table>\n";
  for (const auto& [name, value] : rows) {
    html += fmt::format("<tr><td>{}</td><td class=\"n\">{}</td></tr>\n", html_text(name),
                        html_text(value));
  }
  return html + "</table>\n";
}

std::string short_number(const Json& value) {
  return value.is_number_float() ? fmt::format("{:.4g}", value.get<double>()) : value.dump();
}

std::string warnings(const Json& report) {
  const Json& list = report["warnings"];
  std::string html = list.empty() ? "<div class=\"fine\">No warnings.</div>\n"
                                  : fmt::format(
                                        "<div class=\"warnings\"><b>{}</b>\n<ul>\n{}</ul>"
                                        "</div>\n",
                                        list.size() == 1 ? "Warning" : "Warnings", list_of(list));
  const Json& notes = report["input"]["notes"];
  if (!notes.empty()) {
    html +=
        "<p>What was done to the input:</p>\n<ul class=\"notes\">\n" + list_of(notes) + "</ul>\n";
  }
  return html;
}

std::string thickness_text(const Json& side) {
  const std::string least = short_number(side["thickness_given"]["min"]);
  const std::string greatest = short_number(side["thickness_given"]["max"]);
  return least == greatest ? least : least + " … " + greatest;
}

std::string facts(const PipelineResult& r, const Json& report) {
  const std::string units = report["options"]["units"];
  Rows rows{{"quads", report["quads"]["count"].dump()},
            {"hexahedra", report["wall"]["hexes"].dump()},
            {"layers", report["wall"]["layers"].dump()},
            {"irregular vertices", report["quads"]["irregular"].dump()},
            {"corner angles, quads",
             fmt::format("90° ± {:.2f}°", report["quads"]["angle_stddev_deg"].get<double>())},
            {"least scaled Jacobian, quads", short_number(report["quads"]["min_scaled_jacobian"])},
            {"least scaled Jacobian, hexes", short_number(report["wall"]["min_scaled_jacobian"])}};
  if (r.outward) rows.emplace_back("wall, " + units, thickness_text(report["wall"]["outward"]));
  if (r.inward) {
    rows.emplace_back("lumen layers, " + units, thickness_text(report["wall"]["inward"]));
  }
  rows.emplace_back("target edge, " + units, short_number(report["options"]["size"]));
  std::string html = "<div class=\"facts\">\n";
  for (const auto& [name, value] : rows) {
    html += fmt::format("<div><b>{}</b><span>{}</span></div>\n", html_text(value), html_text(name));
  }
  return html + "</div>\n";
}

std::string figure(const std::string& content, const std::string& caption) {
  return fmt::format("<figure>\n{}<figcaption>{}</figcaption></figure>\n", content,
                     html_text(caption));
}

std::string pictures(const PageParts& parts) {
  std::string html;
  for (const PagePicture& picture : parts.pictures) {
    html += figure(fmt::format("<img alt=\"{}\" src=\"data:image/png;base64,{}\">\n", picture.name,
                               base64(picture.png)),
                   picture.caption);
  }
  if (!html.empty()) html = "<div class=\"grid\">\n" + html + "</div>\n";
  if (!parts.pictures_note.empty()) html += "<p>" + html_text(parts.pictures_note) + "</p>\n";
  return html.empty() ? html : section("Pictures", html, "pictures");
}

AnyMesh as_any_mesh(const QuadMesh& quads) {
  AnyMesh mesh;
  mesh.points = quads.points;
  for (const auto& quad : quads.quads) mesh.add(ElementShape::quad, quad, mesh.size());
  return mesh;
}

// From and to multiples of `step` around the values.
Bins bins_around(const std::vector<double>& values, double step, int count) {
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  return {step * std::floor(*least / step), step * std::ceil(*greatest / step), count};
}

std::string opening_rows(const Json& report) {
  std::string html =
      "<table>\n<tr><th>opening</th><th class=\"n\">radius</th><th>centre</th>"
      "<th>planar</th></tr>\n";
  for (const Json& opening : report["input"]["openings"]) {
    const Json& c = opening["center"];
    html +=
        fmt::format("<tr><td>{}</td><td class=\"n\">{}</td><td>({}, {}, {})</td><td>{}</td></tr>\n",
                    html_text(opening["name"].get<std::string>()), short_number(opening["radius"]),
                    short_number(c[0]), short_number(c[1]), short_number(c[2]),
                    opening["planar"].get<bool>() ? "yes" : "no");
  }
  return html + "</table>\n";
}

std::string pole_rows(const Json& report) {
  if (report["poles"].empty()) return {};
  std::string html =
      "<table>\n<tr><th>pole</th><th>place</th><th class=\"n\">quads around</th>"
      "<th class=\"n\">area more than 2× off in size, %</th></tr>\n";
  int number = 0;
  for (const Json& pole : report["poles"]) {
    const Json& c = pole["center"];
    html += fmt::format(
        "<tr><td>pole_{}</td><td>({}, {}, {})</td><td class=\"n\">{}</td><td class=\"n\">{:.3g} → "
        "{:.3g}</td></tr>\n",
        ++number, short_number(c[0]), short_number(c[1]), short_number(c[2]),
        pole["quads_around"].dump(), 100.0 * pole["off_size_area_fraction_before"].get<double>(),
        100.0 * pole["off_size_area_fraction_after"].get<double>());
  }
  return html + "</table>\n";
}

// Numbers, texts and truths of a part of the report, its parts with their names before.
void add_rows(const Json& part, const std::string& prefix, Rows& rows) {
  for (const auto& [key, value] : part.items()) {
    const std::string name = prefix.empty() ? key : fmt::format("{}.{}", prefix, key);
    if (value.is_object()) {
      add_rows(value, name, rows);
    } else if (value.is_string()) {
      rows.emplace_back(name, value.get<std::string>());
    } else if (!value.is_array()) {
      rows.emplace_back(name, short_number(value));
    }
  }
}

std::string counts(const Json& report) {
  Rows rows;
  for (const char* key : {"input", "preparation", "refined", "basis", "energy", "zeros",
                          "cylinders", "strips", "quads", "wall"}) {
    Rows part;
    add_rows(report[key], key, part);
    rows.insert(rows.end(), part.begin(), part.end());
  }
  Rows options;
  add_rows(report["options"], "", options);
  return section("Openings", opening_rows(report) + pole_rows(report)) +
         "<details>\n<summary>All numbers and options</summary>\n<div class=\"grid\">\n" +
         table(rows) + table(options) + "</div></details>\n";
}

std::string times(const Json& report) {
  Rows rows;
  for (const auto& [stage, seconds] : report["seconds"].items()) {
    rows.emplace_back(stage, fmt::format("{:.2f} s", seconds.get<double>()));
  }
  const double megabytes = report["peak_memory_bytes"].get<double>() / 1e6;
  rows.emplace_back("peak memory", fmt::format("{:.0f} MB", megabytes));
  return section("Times", table(rows), "times");
}

// A script can't hold the end tag of its own element.
std::string embeddable(std::string_view script) {
  std::string text(script);
  for (std::size_t at = text.find("</script"); at != std::string::npos;
       at = text.find("</script", at)) {
    text.insert(at + 1, 1, '\\');
  }
  return text;
}

constexpr std::string_view controls = R"html(<div class="controls">
<label>Colour <select id="view-colour"></select></label>
<label>Cut <select id="view-cut"><option value="">off</option><option>x</option><option>y</option>
<option>z</option><option value="eye">across the view</option></select></label>
<input id="view-place" type="range" min="0" max="1" step="0.005" value="0.5" disabled aria-label="Place of the cut">
<label><input id="view-flip" type="checkbox" disabled> other side</label>
<label><input id="view-edges" type="checkbox" checked> edges</label>
<button id="view-reset" type="button">Reset</button>
</div>
<div id="view"></div>
<div id="view-legend"></div>
<p>Drag to turn, wheel to zoom, Shift and drag to move. A cut shows whole cells.</p>
)html";

std::string view(const PageParts& parts) {
  if (parts.view_script.empty()) {
    return section("3-D view",
                   "<p>This hexwall was built without its 3-D view, for which Node.js "
                   "is needed. ParaView opens wall.vtu and quads.vtp.</p>\n");
  }
  std::string html(controls);
  html += "<script type=\"application/json\" id=\"view-meta\">" + parts.view.meta + "</script>\n";
  html += "<script type=\"text/plain\" id=\"view-data\">" + parts.view.base64 + "</script>\n";
  return section("3-D view", html, "view-section");
}

}  // namespace

std::string distribution_plots(const PipelineResult& r) {
  const AnyMesh mesh = as_any_mesh(r.quads);
  std::vector<int> all(r.quads.quads.size());
  for (std::size_t q = 0; q < all.size(); ++q) all[q] = static_cast<int>(q);
  CornerValues corners = measure_corners(mesh, all);
  Bins ratio_bins = log_ratio_bins(corners.log_edge_ratio);
  ratio_bins.count = 80;
  const Bins near_right = bins_around(corners.angle, 10.0, 45);
  const Bins up_to_one{bins_around(r.wall_scaled_jacobian, 0.1, 0).low, 1.0, 40};
  const Distribution angles = distribution_of(std::move(corners.angle), near_right);
  const Distribution ratios = distribution_of(std::move(corners.log_edge_ratio), ratio_bins);
  const Distribution jacobians = distribution_of(r.wall_scaled_jacobian, up_to_one);
  const OptimumResult& optimum = r.solution.optimum;
  std::string html = "<div class=\"grid\">\n";
  html += figure(svg_histogram(angles.histogram, "degrees", 90.0), "Corner angles of the quads.");
  html += figure(svg_histogram(ratios.histogram, "ln(edge / next edge)", 0.0),
                 "Logarithms of the ratios of adjacent edge lengths of the quads.");
  html += figure(svg_histogram(jacobians.histogram, "scaled Jacobian", 1.0),
                 "Scaled Jacobians of the hexahedra.");
  html += figure(svg_curve(optimum.descents[optimum.best].iterations, "iteration", "energy"),
                 "Energy (area distortion) of the best descent.");
  return section("Distributions", html + "</div>\n");
}

std::string report_page(const PipelineResult& r, const Json& report, const PageParts& parts) {
  const std::string file =
      std::filesystem::path(report["input"]["file"].get<std::string>()).filename().string();
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta "
      "name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{0} – "
      "hexwall</title>\n<link rel=\"icon\" href=\"data:,\">\n<style>{1}</style>\n</head>\n<body>\n"
      "<h1>{0}<small>hexwall {2}</small></h1>\n",
      html_text(file), style, report["hexwall_version"].get<std::string>());
  html += warnings(report);
  html += facts(r, report);
  html += view(parts);
  html += pictures(parts);
  html += parts.distributions;
  html += counts(report);
  html += times(report);
  if (!parts.view_script.empty()) {
    html += "<script>" + embeddable(parts.view_script) + "</script>\n";
  }
  return html + "</body>\n</html>\n";
}

}  // namespace hexwall
