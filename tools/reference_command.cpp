#include "reference_command.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "exporters/formats.h"
#include "exporters/output_file.h"
#include "reference.h"

namespace hexwall {
namespace {

constexpr const char* program_name = "hexwall";

struct ReferenceOptions {
  std::string what;
  std::string folder;
};

std::string all_options_markdown(const CLI::App& app) {
  std::string text;
  for (const CommandInfo& command : commands_of(program_name, app)) {
    text += fmt::format("\n### {}\n\n{}.\n{}", command.name, command.summary,
                        options_markdown(command));
  }
  return text;
}

std::string formats_markdown() {
  std::string text = "\n| `--write` | file or folder |\n|---|---|\n";
  for (const Format& format : hex_mesh_formats()) {
    text += fmt::format("| `{}` | `{}` |\n", format.name, format.output);
  }
  return text;
}

// Pages of the program and of its commands.
void write_man_pages(const CLI::App& app, const std::filesystem::path& folder) {
  const std::vector<CommandInfo> commands = commands_of(program_name, app);
  const CommandInfo program{program_name, "hexahedral wall meshes of blood vessels", {}};
  std::vector<OutputFile> files{{"hexwall.1", man_page(program, commands)}};
  for (const CommandInfo& command : commands) {
    std::string name = command.name;
    name.replace(name.find(' '), 1, "-");
    files.push_back({name + ".1", man_page(command, {program_name})});
  }
  write_output_files(folder, files);
}

ExitCode run_reference(const ReferenceOptions& c, const CLI::App& app) {
  if (c.what == "options") fmt::print("{}", all_options_markdown(app));
  if (c.what == "exit-codes") fmt::print("{}", exit_codes_markdown());
  if (c.what == "report") fmt::print("{}", report_markdown());
  if (c.what == "formats") fmt::print("{}", formats_markdown());
  if (c.what == "bash") {
    fmt::print("{}", bash_completion({program_name, "", {}}, commands_of(program_name, app)));
  }
  if (c.what == "man") write_man_pages(app, c.folder);
  return ExitCode::success;
}

}  // namespace

Command add_reference(CLI::App& app) {
  CLI::App* reference = app.add_subcommand("reference", "What the program says of itself");
  reference->group("");
  const auto c = std::make_shared<ReferenceOptions>();
  reference->add_option("WHAT", c->what)
      ->required()
      ->check(CLI::IsMember({"options", "exit-codes", "report", "formats", "bash", "man"}));
  reference->add_option("FOLDER", c->folder, "Where manual pages are written to")->default_val(".");
  return {reference, [c, &app] { return run_reference(*c, app); }};
}

}  // namespace hexwall
