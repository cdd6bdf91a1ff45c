// The reference of report.json and reports themselves cannot drift apart.

#include "report_keys.h"

#include <map>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "pipeline.h"
#include "report.h"
#include "support/capped.h"
#include "support/vessel_surfaces.h"

namespace hexwall::test {
namespace {

using Json = nlohmann::ordered_json;

// a.{b,c} as a.b and a.c.
std::vector<std::string> expanded(const std::string& path) {
  const std::size_t open = path.find('{');
  if (open == std::string::npos) return {path};
  const std::size_t close = path.find('}', open);
  std::vector<std::string> paths;
  for (std::size_t start = open + 1; start <= close;) {
    const std::size_t end = std::min(path.find(',', start), close);
    const std::string name = path.substr(start, end - start);
    for (std::string& p : expanded(path.substr(0, open) + name + path.substr(close + 1))) {
      paths.push_back(std::move(p));
    }
    start = end + 1;
  }
  return paths;
}

// The paths of all values of a report, each with those of the objects and lists around it.
void add_paths(const Json& json, const std::string& path, std::set<std::string>& leaves,
               std::set<std::string>& all) {
  all.insert(path);
  const bool is_list_of_objects = json.is_array() && !json.empty() && json[0].is_object();
  if (json.is_object()) {
    for (const auto& [key, value] : json.items()) {
      std::string below = path;
      if (!below.empty()) below += '.';
      add_paths(value, below + key, leaves, all);
    }
  } else if (is_list_of_objects) {
    for (const Json& item : json) add_paths(item, path + "[]", leaves, all);
  } else {
    if (!json.is_array() || !json.empty()) leaves.insert(path);
    all.insert(path + "[]");
  }
}

Json report_of(const TriangleSurface& surface, const PrepareOptions& preparation,
               const PipelineOptions& options) {
  const PrepareResult prepared = prepare_surface({surface, {}, {}, {}}, preparation);
  const PipelineResult result = run_pipeline(prepared, options);
  return make_report(result, {"memory", "mm", 0, 0, &prepared, {{"read", 0.0}}});
}

// Reports that have every key between them: poles, two sides with layers that had to be thinner,
// repairs, opened caps and extensions.
std::vector<Json> reports() {
  PipelineOptions both;
  both.size = 0.3;
  both.inward = LayerOptions{};
  both.outward->thickness = 4.0;
  both.inward->thickness = 0.8;
  TriangleSurface dirty = capped(cylinder(1.0, 6.0, 20, 16), CapStyle::wheel);
  dirty.triangles.push_back(dirty.triangles.front());
  PrepareOptions extended;
  extended.extend = 1.0;
  PipelineOptions plain;
  plain.size = 0.5;
  return {report_of(tube_with_sac(), {}, both), report_of(dirty, extended, plain)};
}

TEST(ReportKeys, AreThoseOfReports) {
  std::set<std::string> leaves;
  std::set<std::string> all;
  for (const Json& report : reports()) add_paths(report, "", leaves, all);
  std::set<std::string> documented;
  for (const ReportKey& key : report_keys()) {
    EXPECT_FALSE(key.meaning.empty()) << key.path;
    for (const std::string& path : expanded(key.path)) {
      EXPECT_TRUE(documented.insert(path).second) << path << " is there twice";
      EXPECT_TRUE(all.contains(path)) << "no report has " << path;
    }
  }
  const auto is_documented = [&](std::string path) {
    for (;;) {
      if (documented.contains(path) || documented.contains(path + "[]")) return true;
      const std::size_t dot = path.rfind('.');
      if (dot == std::string::npos) return false;
      path.resize(dot);
    }
  };
  for (const std::string& leaf : leaves) {
    EXPECT_TRUE(is_documented(leaf)) << leaf << " is not in report_keys()";
  }
}

}  // namespace
}  // namespace hexwall::test
