#include "support/check_mesh.h"

#include <array>
#include <cstdio>
#include <cstdlib>

namespace hexwall {
namespace {

/// `text` as one word of the shell.
std::string quoted(const std::string& text) {
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

std::string output_of(const std::string& command) {
  std::string output;
  std::FILE* pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) return output;
  std::array<char, 4096> buffer;
  while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), pipe))
    output.append(buffer.data(), n);
  ::pclose(pipe);
  return output;
}

}  // namespace

CheckMeshResult check_mesh(const std::filesystem::path& case_dir, const std::string& options) {
  CheckMeshResult result;
  result.available = !output_of("command -v checkMesh").empty();
  if (!result.available) return result;
  // Debian's package looks for its dictionaries there unless the environment says otherwise.
  result.log = output_of("cd " + quoted(case_dir.string()) +
                         " && WM_PROJECT_DIR=${WM_PROJECT_DIR:-/usr/share/openfoam}"
                         " checkMesh " +
                         options + " 2>&1");
  result.ok = result.log.find("Mesh OK.") != std::string::npos;
  return result;
}

}  // namespace hexwall
