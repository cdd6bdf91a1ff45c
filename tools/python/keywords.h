#pragma once

#include <pybind11/pybind11.h>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace hexwall::python {

/// Gives the options of a command the values of keywords: `thickness_ratio=0.1` is
/// `--thickness-ratio 0.1`, a flag takes a bool, a list a sequence; None is as if it were not
/// there. All that the command line checks is checked.
/// \param arguments of the command that are no keywords, already as on the command line.
/// \throws UsageError; TypeError in Python for an unknown keyword or a value of the wrong kind.
void parse_keywords(CLI::App& command, const pybind11::dict& keywords,
                    std::vector<std::string> arguments);

/// The options of a command as a list of dicts, keywords as they are called in Python.
pybind11::list option_dicts(const CLI::App& command);

}  // namespace hexwall::python
