#include "hex/layers.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <numeric>
#include <sstream>

#include <fmt/format.h>

#include "core/errors.h"
#include "surface/names.h"

namespace hexwall {
namespace {

// Heights of the layer boundaries from 0 to 1, 0 left out, and the group of each layer.
struct Heights {
  std::vector<double> upper;
  std::vector<int> group;
};

Heights heights_of(const std::vector<LayerGroup>& groups) {
  const double total =
      std::accumulate(groups.begin(), groups.end(), 0.0,
                      [](double sum, const LayerGroup& group) { return sum + group.share; });
  Heights heights;
  double below = 0.0;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    for (int i = 1; i <= groups[g].cells; ++i) {
      heights.upper.push_back((below + groups[g].share * i / groups[g].cells) / total);
      heights.group.push_back(static_cast<int>(g));
    }
    below += groups[g].share;
  }
  if (!heights.upper.empty()) heights.upper.back() = 1.0;
  return heights;
}

template <typename Number>
bool read_number(const std::string& text, Number& value) {
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && rest == end;
}

LayerGroup parse_group(const std::string& part) {
  std::vector<std::string> words;
  std::istringstream stream(part);
  for (std::string word; std::getline(stream, word, ':');) words.push_back(word);
  LayerGroup group;
  if (words.size() != 3 || !read_number(words[1], group.share) ||
      !read_number(words[2], group.cells)) {
    throw UsageError(
        fmt::format("--layer-spec: '{}' should read name:share:hexes, as in media:0.55:2", part));
  }
  if (!(group.share > 0.0) || !std::isfinite(group.share) || group.cells < 1) {
    throw UsageError(fmt::format("--layer-spec: the numbers of '{}' must be positive", part));
  }
  group.name = words[0];
  if (!is_valid_name(group.name)) {
    throw UsageError(fmt::format("--layer-spec: '{}' is no name for a cell zone: {}", group.name,
                                 valid_name_rule()));
  }
  return group;
}

}  // namespace

std::vector<LayerGroup> graded_layers(int layers, double growth, const std::string& prefix) {
  std::vector<LayerGroup> groups;
  double height = 1.0;
  for (int i = 0; i < layers; ++i, height *= growth) {
    groups.push_back({fmt::format("{}{}", prefix, i + 1), height, 1});
  }
  return groups;
}

std::vector<double> LayerPlan::outer_levels() const {
  return {levels.begin() + inner, levels.end()};
}

std::vector<double> LayerPlan::inner_levels() const {
  return {levels.begin(), levels.begin() + inner + 1};
}

LayerPlan plan_layers(const std::vector<LayerGroup>& outward,
                      const std::vector<LayerGroup>& inward) {
  const Heights below = heights_of(inward);
  const Heights above = heights_of(outward);
  LayerPlan plan;
  plan.inner = static_cast<int>(below.upper.size());
  std::transform(inward.rbegin(), inward.rend(), std::back_inserter(plan.zone_names),
                 [](const LayerGroup& group) { return group.name; });
  for (std::size_t i = below.upper.size(); i-- > 0;) {
    plan.levels.push_back(-below.upper[i]);
    plan.zone.push_back(static_cast<int>(inward.size()) - 1 - below.group[i]);
  }
  plan.levels.push_back(0.0);
  for (std::size_t i = 0; i < above.upper.size(); ++i) {
    plan.levels.push_back(above.upper[i]);
    plan.zone.push_back(static_cast<int>(inward.size()) + above.group[i]);
  }
  for (const LayerGroup& group : outward) plan.zone_names.push_back(group.name);
  return plan;
}

std::vector<LayerGroup> parse_layers(const std::string& text) {
  std::vector<LayerGroup> groups;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, ',');) {
    groups.push_back(parse_group(part));
    const auto same = std::count_if(groups.begin(), groups.end(), [&](const LayerGroup& g) {
      return g.name == groups.back().name;
    });
    if (same > 1) {
      throw UsageError(fmt::format("--layer-spec: '{}' occurs twice", groups.back().name));
    }
  }
  if (groups.empty()) throw UsageError("--layer-spec is empty");
  return groups;
}

}  // namespace hexwall
