#include "support/foam_run.h"

#include <fstream>
#include <limits>
#include <sstream>

#include "support/child_process.h"

namespace hexwall::test {

bool is_installed(const std::string& program) {
  return run_child({"which", program}).exit_code == 0;
}

std::string run_case(const std::filesystem::path& case_dir) {
  const ChildResult result = run_child({(case_dir / "Allrun").string()});
  if (result.exit_code == 0) return "";
  return "Allrun ended with " + std::to_string(result.exit_code) + ":\n" + result.out + result.err;
}

double last_value(const std::filesystem::path& case_dir, const std::string& function) {
  std::ifstream file(case_dir / "postProcessing" / function / "0/surfaceFieldValue.dat");
  double value = std::numeric_limits<double>::quiet_NaN();
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    double time = 0.0;
    double next = 0.0;
    if (words >> time >> next) value = next;
  }
  return value;
}

}  // namespace hexwall::test
