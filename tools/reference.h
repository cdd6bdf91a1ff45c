#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "option_list.h"

namespace hexwall {

/// A program, or a command of one, as its reference pages show it.
struct CommandInfo {
  std::string name;  ///< "hexwall mesh"
  std::string summary;
  std::vector<OptionInfo> options;
};

CommandInfo command_info(const std::string& name, const CLI::App& app);

/// The commands of a program that its --help shows.
std::vector<CommandInfo> commands_of(const std::string& program, const CLI::App& app);

/// Tables of the arguments and options in Markdown, one for each group.
std::string options_markdown(const CommandInfo& command);

/// Table of the exit codes in Markdown.
std::string exit_codes_markdown();

/// Table of the keys of report.json in Markdown.
std::string report_markdown();

/// A manual page of section 1. \param others pages to see as well.
std::string man_page(const CommandInfo& command, const std::vector<std::string>& others);

/// The manual page of a program with commands.
std::string man_page(const CommandInfo& program, const std::vector<CommandInfo>& commands);

/// A script for bash that completes the commands, options and choices of a program, and files
/// elsewhere. Needs nothing but bash. \param commands none: the program's own options
std::string bash_completion(const CommandInfo& program, const std::vector<CommandInfo>& commands);

}  // namespace hexwall
