#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace hexwall {

/// An option of a command, as users see it.
struct OptionInfo {
  std::string name;        ///< without dashes: `size`, or that of an argument: SURFACE
  std::string short_name;  ///< `o` of -o, may be empty
  std::string type;        ///< text, number, integer, list; empty: a flag
  std::vector<std::string> choices;
  std::string default_value;  ///< in words where it is no constant; empty: none
  std::string meaning;
  std::string group;  ///< empty: none in particular
  bool is_argument = false;
  bool is_required = false;
};

/// All options and arguments of a command, in the order of its --help; --help itself is left out.
std::vector<OptionInfo> options_of(const CLI::App& command);

}  // namespace hexwall
