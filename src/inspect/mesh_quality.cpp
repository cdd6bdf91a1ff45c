#include "inspect/mesh_quality.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "surface/counted.h"

namespace hexwall {
namespace {

using Json = nlohmann::ordered_json;

std::vector<int> elements_to_measure(const AnyMesh& mesh, bool of_volume) {
  std::vector<int> elements;
  for (int e = 0; e < mesh.size(); ++e) {
    if (is_volume(mesh.shape[e]) == of_volume) elements.push_back(e);
  }
  return elements;
}

WorstPlace place_of(const AnyMesh& mesh, int element, double value) {
  return {std::string(name(mesh.shape[element])), mesh.label[element], center_of(mesh, element),
          value};
}

std::vector<WorstPlace> worst_of(const AnyMesh& mesh, const std::vector<int>& elements,
                                 const MetricValues& values, bool low_is_bad, std::size_t count) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isnan(values[i])) order.push_back(i);
  }
  count = std::min(count, order.size());
  const auto is_worse = [&](std::size_t a, std::size_t b) {
    if (values[a] == values[b]) return a < b;
    return low_is_bad ? values[a] < values[b] : values[a] > values[b];
  };
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count), order.end(),
                    is_worse);
  std::vector<WorstPlace> worst;
  for (std::size_t k = 0; k < count; ++k) {
    worst.push_back(place_of(mesh, elements[order[k]], values[order[k]]));
  }
  return worst;
}

MetricResult result_of(const AnyMesh& mesh, const std::vector<int>& elements,
                       const CellMetric& metric, const MetricValues& values, std::size_t worst) {
  MetricResult result{metric, {}, {}, {}};
  std::vector<double> all;
  std::array<std::vector<double>, element_shapes> by_shape;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isnan(values[i])) continue;
    all.push_back(values[i]);
    by_shape[static_cast<std::size_t>(mesh.shape[elements[i]])].push_back(values[i]);
  }
  if (all.empty()) return result;
  for (std::size_t s = 0; s < by_shape.size(); ++s) {
    if (by_shape[s].empty()) continue;
    result.by_shape.emplace_back(static_cast<ElementShape>(s),
                                 distribution_of(std::move(by_shape[s]), metric.bins));
  }
  result.all = distribution_of(std::move(all), metric.bins);
  result.worst = worst_of(mesh, elements, values, metric.low_is_bad, worst);
  return result;
}

std::vector<FoamResult> foam_results(const AnyMesh& mesh, std::size_t worst,
                                     std::vector<std::string>& notes) {
  const CellFaces cells = cell_faces(mesh);
  if (cells.overfull > 0) {
    notes.push_back(counted(cells.overfull, "face is", "faces are") +
                    " shared by more than two cells");
  }
  std::vector<FoamResult> results;
  for (FoamMetric& metric : foam_metrics(cells.faces, mesh.points)) {
    FoamResult result{std::move(metric), {}};
    const FoamMetric& m = result.metric;
    const auto add = [&](int i, double value) {
      if (m.is_of_faces) {
        const int owner = cells.element[cells.faces.owner[i]];
        result.worst.push_back({"face of " + mesh.label_word, mesh.label[owner],
                                center_of_face(cells.faces, mesh.points, i), value});
      } else {
        result.worst.push_back(place_of(mesh, cells.element[i], value));
      }
    };
    for (std::size_t k = 0; k < std::min(worst, m.beyond.size()); ++k) {
      add(m.beyond[k], m.of_beyond[k]);
    }
    if (m.beyond.empty() && m.worst >= 0 && worst > 0) add(m.worst, m.low_is_bad ? m.min : m.max);
    results.push_back(std::move(result));
  }
  return results;
}

Json worst_json(const std::vector<WorstPlace>& places) {
  Json list = Json::array();
  for (const WorstPlace& place : places) {
    list.push_back({{"what", place.what},
                    {"label", place.label},
                    {"at", {place.at.x(), place.at.y(), place.at.z()}},
                    {"value", place.value}});
  }
  return list;
}

Json metric_json(const MetricResult& result) {
  Json json = to_json(result.all);
  json["unit"] = result.metric.unit;
  Json by_shape = Json::object();
  for (const auto& [shape, distribution] : result.by_shape) {
    by_shape[std::string(name(shape))] = to_json(distribution);
  }
  json["by_shape"] = std::move(by_shape);
  json["worst"] = worst_json(result.worst);
  return json;
}

Json foam_json(const FoamResult& result) {
  const FoamMetric& m = result.metric;
  return {{"of", m.is_of_faces ? "faces" : "cells"},
          {"count", m.count},
          {"min", m.min},
          {"max", m.max},
          {"mean", m.mean},
          {"threshold", m.threshold},
          {"bad_side", m.low_is_bad ? "below" : "above"},
          {"set", m.set},
          {"beyond", m.beyond.size()},
          {"worst", worst_json(result.worst)}};
}

void add_figures(const std::string& prefix, const std::string& metric, const Distribution& d,
                 Figures& figures) {
  // What is a least or greatest value itself has one end of interest, under its own name.
  if (metric == "min_angle") {
    figures.emplace_back(prefix + metric, d.min);
  } else if (metric == "max_angle") {
    figures.emplace_back(prefix + metric, d.max);
  } else {
    figures.emplace_back(prefix + "min_" + metric, d.min);
    figures.emplace_back(prefix + "max_" + metric, d.max);
  }
  figures.emplace_back(prefix + "mean_" + metric, d.mean);
}

}  // namespace

MeshQuality mesh_quality(const AnyMesh& mesh, std::size_t worst) {
  MeshQuality q;
  q.points = mesh.points.size();
  q.notes = mesh.notes;
  for (const ElementShape shape : mesh.shape) ++q.count[static_cast<std::size_t>(shape)];
  q.is_of_volume = std::any_of(mesh.shape.begin(), mesh.shape.end(), is_volume);
  const std::vector<int> elements = elements_to_measure(mesh, q.is_of_volume);
  if (elements.size() < mesh.shape.size()) {
    q.notes.push_back(
        counted(mesh.shape.size() - elements.size(), "surface element is", "surface elements are") +
        " not measured: the cells are");
  }
  const std::vector<MetricValues> values = measure_cells(mesh, elements);
  for (std::size_t m = 0; m < values.size(); ++m) {
    MetricResult result = result_of(mesh, elements, cell_metrics()[m], values[m], worst);
    if (result.all.count > 0) q.metrics.push_back(std::move(result));
  }
  CornerValues corners = measure_corners(mesh, elements);
  q.corner_angle = distribution_of(std::move(corners.angle), angle_bins);
  const Bins ratio_bins = log_ratio_bins(corners.log_edge_ratio);
  q.log_edge_ratio = distribution_of(std::move(corners.log_edge_ratio), ratio_bins);
  if (q.is_of_volume) q.foam = foam_results(mesh, worst, q.notes);
  return q;
}

Figures figures_of(const MeshQuality& q) {
  Figures figures{{"points", static_cast<double>(q.points)}};
  std::size_t measured = 0;
  for (std::size_t s = 0; s < q.count.size(); ++s) {
    const auto shape = static_cast<ElementShape>(s);
    if (is_volume(shape) == q.is_of_volume) measured += q.count[s];
  }
  figures.emplace_back("cells", static_cast<double>(measured));
  for (const MetricResult& result : q.metrics) {
    add_figures("", std::string(result.metric.name), result.all, figures);
  }
  for (const MetricResult& result : q.metrics) {
    for (const auto& [shape, distribution] : result.by_shape) {
      add_figures(std::string(name(shape)) + ".", std::string(result.metric.name), distribution,
                  figures);
    }
  }
  for (const FoamResult& result : q.foam) {
    const FoamMetric& m = result.metric;
    if (m.count == 0) continue;
    figures.emplace_back("openfoam.min_" + m.name, m.min);
    figures.emplace_back("openfoam.max_" + m.name, m.max);
    figures.emplace_back("openfoam.mean_" + m.name, m.mean);
    figures.emplace_back("openfoam." + m.set, static_cast<double>(m.beyond.size()));
  }
  return figures;
}

Json to_json(const Distribution& d) {
  Json quantiles = Json::object();
  for (std::size_t i = 0; i < quantile_levels.size(); ++i) {
    quantiles[fmt::format("{:g}%", 100.0 * quantile_levels[i])] = d.quantiles[i];
  }
  return {
      {"count", d.count},
      {"min", d.min},
      {"max", d.max},
      {"mean", d.mean},
      {"quantiles", std::move(quantiles)},
      {"histogram",
       {{"low", d.histogram.low}, {"width", d.histogram.width}, {"counts", d.histogram.counts}}}};
}

Json to_json(const MeshQuality& q) {
  Json json;
  json["points"] = q.points;
  json["elements"] = Json::object();
  for (std::size_t s = 0; s < q.count.size(); ++s) {
    if (q.count[s] > 0) {
      json["elements"][std::string(name(static_cast<ElementShape>(s)))] = q.count[s];
    }
  }
  json["measured"] = q.is_of_volume ? "volume" : "surface";
  json["notes"] = q.notes;
  json["figures"] = Json::object();
  for (const auto& [figure, value] : figures_of(q)) json["figures"][figure] = value;
  for (const MetricResult& result : q.metrics) {
    json["metrics"][std::string(result.metric.name)] = metric_json(result);
  }
  json["corner_angle"] = to_json(q.corner_angle);
  json["log_edge_ratio"] = to_json(q.log_edge_ratio);
  for (const FoamResult& result : q.foam) json["openfoam"][result.metric.name] = foam_json(result);
  return json;
}

}  // namespace hexwall
