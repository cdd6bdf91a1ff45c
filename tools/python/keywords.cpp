#include "keywords.h"

#include <algorithm>
#include <pybind11/stl.h>

#include <fmt/format.h>

#include "core/errors.h"
#include "option_list.h"

namespace hexwall::python {
namespace {

namespace py = pybind11;

std::string keyword_of(std::string name) {
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

// A value as on the command line: shortest decimals that read back to the same number.
std::string text_of(const py::handle& value) {
  if (py::hasattr(value, "__fspath__")) {
    return py::module_::import("os").attr("fspath")(value).cast<std::string>();
  }
  return py::str(value).cast<std::string>();
}

bool is_sequence(const py::handle& value) {
  return py::isinstance<py::sequence>(value) && !py::isinstance<py::str>(value);
}

std::string joined(const py::handle& sequence) {
  std::string text;
  for (const py::handle& item : sequence) text += (text.empty() ? "" : ",") + text_of(item);
  return text;
}

[[noreturn]] void refuse(const std::string& keyword, const std::string& wanted,
                         const py::handle& value) {
  throw py::type_error(
      fmt::format("{} is {}, not {}", keyword, wanted, py::repr(value).cast<std::string>()));
}

void add_argument(const OptionInfo& option, const py::handle& value,
                  std::vector<std::string>& arguments) {
  const std::string keyword = keyword_of(option.name);
  const bool is_bool = py::isinstance<py::bool_>(value);
  if (option.type.empty()) {
    if (!is_bool) refuse(keyword, "True or False", value);
    if (value.cast<bool>()) arguments.push_back("--" + option.name);
    return;
  }
  if (is_bool || (is_sequence(value) && option.type != "list")) {
    refuse(keyword, option.type == "list" ? "a list" : "a " + option.type, value);
  }
  const std::string text = is_sequence(value) ? joined(value) : text_of(value);
  if (text.empty()) throw UsageError(fmt::format("--{}: the value is empty", option.name));
  arguments.push_back(fmt::format("--{}={}", option.name, text));
}

}  // namespace

void parse_keywords(CLI::App& command, const py::dict& keywords,
                    std::vector<std::string> arguments) {
  const std::vector<OptionInfo> options = options_of(command);
  for (const auto& [key, value] : keywords) {
    const auto keyword = key.cast<std::string>();
    const auto option = std::find_if(options.begin(), options.end(), [&](const OptionInfo& o) {
      return !o.is_argument && keyword_of(o.name) == keyword;
    });
    if (option == options.end()) {
      throw py::type_error(fmt::format("unexpected keyword argument '{}'", keyword));
    }
    if (!value.is_none()) add_argument(*option, value, arguments);
  }
  std::reverse(arguments.begin(), arguments.end());  // as CLI11 takes them
  try {
    command.parse(std::move(arguments));
  } catch (const CLI::ParseError& error) {
    throw UsageError(error.what());
  }
}

py::list option_dicts(const CLI::App& command) {
  py::list list;
  for (const OptionInfo& o : options_of(command)) {
    using namespace pybind11::literals;
    list.append(py::dict("keyword"_a = keyword_of(o.name), "type"_a = o.type,
                         "choices"_a = o.choices, "default"_a = o.default_value,
                         "meaning"_a = o.meaning, "group"_a = o.group,
                         "is_argument"_a = o.is_argument));
  }
  return list;
}

}  // namespace hexwall::python
