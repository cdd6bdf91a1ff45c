#include "reference.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "core/errors.h"
#include "interrupt.h"
#include "quality_command.h"
#include "report.h"
#include "report_keys.h"

namespace hexwall {
namespace {

struct ExitMeaning {
  int code;
  const char* meaning;
};

constexpr int code(ExitCode c) {
  return static_cast<int>(c);
}

constexpr std::array exit_codes{
    ExitMeaning{code(ExitCode::success), "success"},
    ExitMeaning{code(ExitCode::internal), "internal error: please report it"},
    ExitMeaning{code(ExitCode::usage), "the command line is wrong"},
    ExitMeaning{code(ExitCode::read), "the input is missing, truncated, or of an unknown format"},
    ExitMeaning{code(ExitCode::topology),
                "topology: not a sphere with two or more holes, or not manifold"},
    ExitMeaning{code(ExitCode::geometry), "geometry: non-finite, no area, self-intersecting"},
    ExitMeaning{code(ExitCode::meshing), "the surface is valid, but no valid mesh was found"},
    ExitMeaning{code(ExitCode::write), "the output can't be written"},
    ExitMeaning{condition_holds_exit_code, "a condition of `hexwall quality --fail-if` holds"},
    ExitMeaning{interrupted_exit_code, "stopped by Ctrl-C"},
};

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size()) {
    text.replace(at, what.size(), by);
  }
  return text;
}

std::string joined(const std::vector<std::string>& words, const std::string& between) {
  return fmt::format("{}", fmt::join(words, between));
}

// What stands for the value of an option.
std::string placeholder(const OptionInfo& o) {
  if (o.type == "number") return "X";
  if (o.type == "integer") return "N";
  if (o.type == "list") return "LIST";
  return o.type.empty() ? "" : "TEXT";
}

std::vector<std::string> groups_of(const CommandInfo& command) {
  std::vector<std::string> groups;
  for (const OptionInfo& o : command.options) {
    if (groups.empty() || groups.back() != o.group) groups.push_back(o.group);
  }
  return groups;
}

// --- Markdown -----------------------------------------------------------------------------------

std::string cell(const std::string& text) {
  return replaced(text, "|", "\\|");
}

std::string spelled(const OptionInfo& o) {
  if (o.is_argument) return o.name;
  const std::string short_form = o.short_name.empty() ? "" : "-" + o.short_name + ", ";
  const bool is_choice = !o.choices.empty() && o.type != "list";
  const std::string value = is_choice ? joined(o.choices, "|") : placeholder(o);
  return short_form + "--" + o.name + (value.empty() ? "" : " " + value);
}

std::string meaning(const OptionInfo& o) {
  const bool shows_choices = o.type == "list" && !o.choices.empty();
  return o.meaning + (shows_choices ? ": " + joined(o.choices, ", ") : "");
}

std::string default_text(const OptionInfo& o) {
  return o.is_required ? "required" : o.default_value;
}

// --- manual pages -------------------------------------------------------------------------------

std::string roff(const std::string& text) {
  std::string escaped = replaced(replaced(text, "\\", "\\e"), "-", "\\-");
  if (!escaped.empty() && (escaped[0] == '.' || escaped[0] == '\'')) escaped.insert(0, "\\&");
  return escaped;
}

std::string page_name(const std::string& name) {
  return replaced(name, " ", "-");
}

std::string man_head(const CommandInfo& command, const std::string& synopsis) {
  std::string title = page_name(command.name);
  std::transform(title.begin(), title.end(), title.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return fmt::format(".TH {} 1 \"\" \"hexwall {}\" \"hexwall\"\n.SH NAME\n{} \\- {}\n", roff(title),
                     version(), roff(page_name(command.name)), roff(command.summary)) +
         fmt::format(".SH SYNOPSIS\n\\fB{}\\fR{}\n", roff(command.name), synopsis);
}

std::string man_option(const OptionInfo& o) {
  std::string text = ".TP\n";
  if (o.is_argument) {
    text += "\\fI" + roff(o.name) + "\\fR\n";
  } else {
    const std::string short_form = o.short_name.empty() ? "" : "\\fB\\-" + o.short_name + "\\fR, ";
    const std::string value =
        o.choices.empty() || o.type == "list" ? placeholder(o) : joined(o.choices, "|");
    text += short_form + "\\fB" + roff("--" + o.name) + "\\fR" +
            (value.empty() ? "" : " \\fI" + roff(value) + "\\fR") + "\n";
  }
  text += roff(meaning(o)) + ".\n";
  if (o.is_required && !o.is_argument) text += "Required.\n";
  if (!o.default_value.empty()) text += "Default: " + roff(o.default_value) + ".\n";
  return text;
}

std::string man_exit_codes() {
  std::string text = ".SH EXIT STATUS\n";
  for (const auto& [code, what] : exit_codes) {
    text += fmt::format(".TP\n{}\n{}.\n", code, roff(replaced(what, "`", "")));
  }
  return text;
}

std::string man_see_also(const std::vector<std::string>& pages) {
  std::string text = ".SH SEE ALSO\n";
  for (std::size_t i = 0; i < pages.size(); ++i) {
    const char* end = i + 1 < pages.size() ? "," : "";
    text += fmt::format(".BR {} (1){}\n", roff(page_name(pages[i])), end);
  }
  return text;
}

// --- bash ---------------------------------------------------------------------------------------

std::string option_words(const CommandInfo& command) {
  std::string words;
  for (const OptionInfo& o : command.options) {
    if (!o.is_argument) words += "--" + o.name + " ";
  }
  return words + "--help";
}

// Cases of "command --option" with the words that may follow.
std::string value_cases(const CommandInfo& command, const std::string& prefix) {
  std::string cases;
  for (const OptionInfo& o : command.options) {
    if (o.choices.empty()) continue;
    cases +=
        fmt::format("    \"{}--{}\") values=\"{}\" ;;\n", prefix, o.name, joined(o.choices, " "));
  }
  return cases;
}

std::string last_word(const std::string& name) {
  return name.substr(name.rfind(' ') + 1);
}

constexpr const char* completion_frame =
    R"(# bash completion of {program}, made by the program itself.
{function}() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD - 1]}}
  local command={command} options= values= done=
  # bash takes --option=value apart at the sign.
  if [[ $current == = ]]; then current=; elif [[ $previous == = ]]; then
    previous=${{COMP_WORDS[COMP_CWORD - 2]}}
  fi
  COMPREPLY=()
{choose_command}  case "$command" in
{option_cases}  esac
  case "$command${{command:+ }}$previous" in
{value_cases}    *) ;;
  esac
  if [[ -n $values ]]; then
    # In a list, what is before the last comma is done.
    if [[ $current == *,* ]]; then done=${{current%,*}},; fi
    mapfile -t COMPREPLY < <(compgen -P "$done" -W "$values" -- "${{current##*,}}")
  elif [[ $current == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$options" -- "$current")
  fi
}}
complete -o default -F {function} {program}
)";

}  // namespace

CommandInfo command_info(const std::string& name, const CLI::App& app) {
  return {name, app.get_description(), options_of(app)};
}

std::vector<CommandInfo> commands_of(const std::string& program, const CLI::App& app) {
  std::vector<CommandInfo> commands;
  for (const CLI::App* sub : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (!sub->get_group().empty()) {
      commands.push_back(command_info(program + " " + sub->get_name(), *sub));
    }
  }
  return commands;
}

std::string options_markdown(const CommandInfo& command) {
  std::string text;
  for (const std::string& group : groups_of(command)) {
    if (!group.empty()) text += "\n" + group + ":\n";
    text += "\n| option | default | meaning |\n|---|---|---|\n";
    for (const OptionInfo& o : command.options) {
      if (o.group != group) continue;
      text += fmt::format("| `{}` | {} | {} |\n", cell(spelled(o)), cell(default_text(o)),
                          cell(meaning(o)));
    }
  }
  return text;
}

std::string exit_codes_markdown() {
  std::string text = "\n| exit code | meaning |\n|---|---|\n";
  for (const auto& [code, what] : exit_codes) {
    text += fmt::format("| {} | {} |\n", code, what);
  }
  return text;
}

std::string report_markdown() {
  std::string text = "\n| key | meaning |\n|---|---|\n";
  for (const ReportKey& key : report_keys()) {
    text += fmt::format("| `{}` | {} |\n", key.path, cell(key.meaning));
  }
  return text;
}

std::string man_page(const CommandInfo& command, const std::vector<std::string>& others) {
  std::string synopsis;
  for (const OptionInfo& o : command.options) {
    if (o.is_argument) synopsis += " \\fI" + roff(o.name) + "\\fR";
    if (!o.is_argument && o.is_required) {
      synopsis += fmt::format(" \\fB{}\\fR \\fI{}\\fR", roff("--" + o.name), placeholder(o));
    }
  }
  std::string text = man_head(command, synopsis + " [\\fIoption\\fR ...]");
  for (const std::string& group : groups_of(command)) {
    text += group.empty() ? ".SH OPTIONS\n" : fmt::format(".SS \"{}\"\n", roff(group));
    for (const OptionInfo& o : command.options) {
      if (o.group == group) text += man_option(o);
    }
  }
  return text + man_exit_codes() + man_see_also(others);
}

std::string man_page(const CommandInfo& program, const std::vector<CommandInfo>& commands) {
  std::string text = man_head(program, " \\fIcommand\\fR [\\fIoption\\fR ...]");
  std::vector<std::string> pages;
  text += ".SH COMMANDS\n";
  for (const CommandInfo& command : commands) {
    text += fmt::format(".TP\n\\fB{}\\fR\n{}.\n", roff(command.name), roff(command.summary));
    pages.push_back(command.name);
  }
  pages.emplace_back("hexwall-picture");
  return text + man_exit_codes() + man_see_also(pages);
}

std::string bash_completion(const CommandInfo& program, const std::vector<CommandInfo>& commands) {
  const std::string function = "_" + replaced(program.name, "-", "_");
  std::string names;
  std::string option_cases;
  std::string values;
  for (const CommandInfo& command : commands) {
    const std::string name = last_word(command.name);
    names += name + " ";
    option_cases += fmt::format("    {}) options=\"{}\" ;;\n", name, option_words(command));
    values += value_cases(command, name + " ");
  }
  std::string choose_command;
  if (commands.empty()) {
    option_cases = fmt::format("    *) options=\"{}\" ;;\n", option_words(program));
    values = value_cases(program, "");
  } else {
    option_cases += "    *) ;;\n";
    choose_command = fmt::format(
        "  if ((COMP_CWORD == 1)); then\n    mapfile -t COMPREPLY < <(compgen -W \"{}--help "
        "--version\" -- \"$current\")\n    return\n  fi\n",
        names);
  }
  return fmt::format(fmt::runtime(completion_frame), fmt::arg("program", program.name),
                     fmt::arg("function", function),
                     fmt::arg("command", commands.empty() ? "" : "${COMP_WORDS[1]}"),
                     fmt::arg("choose_command", choose_command),
                     fmt::arg("option_cases", option_cases), fmt::arg("value_cases", values));
}

}  // namespace hexwall
