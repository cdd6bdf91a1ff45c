#include "option_list.h"

#include <algorithm>

namespace hexwall {
namespace {

// CLI11 shows what an option takes as TEXT:{out,in,both}.
std::vector<std::string> choices_in(const std::string& type) {
  const std::size_t open = type.find('{');
  const std::size_t close = type.find('}');
  if (open == std::string::npos || close == std::string::npos) return {};
  return CLI::detail::split(type.substr(open + 1, close - open - 1), ',');
}

std::string type_of(const CLI::Option& option) {
  if (option.get_items_expected_max() == 0) return "";
  if (option.get_delimiter() != '\0' || option.get_items_expected_max() > 1) return "list";
  const std::string type = option.get_type_name();
  if (type.starts_with("FLOAT")) return "number";
  if (type.starts_with("INT") || type.starts_with("UINT")) return "integer";
  return "text";
}

// A default that is no constant stands at the end of the description: [all cores].
void split_default(OptionInfo& info) {
  if (info.meaning.empty() || info.meaning.back() != ']') return;
  const std::size_t open = info.meaning.rfind(" [");
  if (open == std::string::npos || !info.default_value.empty()) return;
  info.default_value = info.meaning.substr(open + 2, info.meaning.size() - open - 3);
  if (info.default_value.starts_with('{') || info.default_value.find("...") != std::string::npos) {
    info.default_value.clear();  // an example of a file
    return;
  }
  info.meaning.resize(open);
}

OptionInfo info_of(const CLI::Option& option) {
  OptionInfo info;
  info.is_argument = !option.nonpositional();
  info.name = info.is_argument ? option.get_name(true) : option.get_lnames().front();
  if (!option.get_snames().empty()) info.short_name = option.get_snames().front();
  info.type = type_of(option);
  info.choices = choices_in(option.get_type_name());
  info.default_value = option.get_default_str();
  std::erase_if(info.default_value, [](char c) { return c == '[' || c == ']'; });
  info.meaning = option.get_description();
  info.is_required = option.get_required();
  if (option.get_group() != "Options") info.group = option.get_group();
  split_default(info);
  return info;
}

}  // namespace

std::vector<OptionInfo> options_of(const CLI::App& command) {
  std::vector<OptionInfo> list;
  for (const CLI::Option* option : command.get_options()) {
    if (option == command.get_help_ptr() || option->get_group().empty()) continue;
    list.push_back(info_of(*option));
  }
  std::stable_partition(list.begin(), list.end(), [](const auto& o) { return o.is_argument; });
  std::stable_sort(list.begin(), list.end(), [](const OptionInfo& a, const OptionInfo& b) {
    return a.group.empty() && !b.group.empty();
  });
  return list;
}

}  // namespace hexwall
