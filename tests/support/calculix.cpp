#include "support/calculix.h"

#include <cctype>
#include <fstream>
#include <sstream>
#include <vector>

#include "support/child_process.h"

namespace hexwall::test {
namespace {

/// What a table of job.dat is, by the words above it.
enum class Table { displacement, position, stress, force, other };

Table table_of(const std::string& title) {
  if (title.starts_with("displacements")) return Table::displacement;
  if (title.starts_with("global coordinates")) return Table::position;
  if (title.starts_with("stresses")) return Table::stress;
  if (title.starts_with("total force")) return Table::force;
  return Table::other;
}

Vec3 vector_at(const std::vector<double>& row, std::size_t i) {
  return {row.at(i), row.at(i + 1), row.at(i + 2)};
}

/// Sums up what are to be means; `points` counts the integration points of each element.
void read_row(Table table, const std::vector<double>& row, CalculixResult& result,
              std::map<int, int>& points) {
  const int id = static_cast<int>(row.at(0));
  switch (table) {
    case Table::displacement:
      result.displacement[id] = vector_at(row, 1);
      break;
    case Table::position:
      result.means[id].position += vector_at(row, 2);
      ++points[id];
      break;
    case Table::stress:
      for (std::size_t i = 0; i < 6; ++i) result.means[id].stress[i] += row.at(i + 2);
      break;
    case Table::force:
      result.total_force = vector_at(row, 0);
      break;
    case Table::other:
      break;
  }
}

void read_tables(std::istream& file, CalculixResult& result) {
  std::map<int, int> points;
  Table table = Table::other;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    if (words >> std::ws; std::isalpha(words.peek()) != 0) {
      table = table_of(line.substr(line.find_first_not_of(' ')));
      continue;
    }
    std::vector<double> row;
    for (double value; words >> value;) row.push_back(value);
    if (!row.empty()) read_row(table, row, result, points);
  }
  for (auto& [id, mean] : result.means) {
    mean.position /= points.at(id);
    for (double& s : mean.stress) s /= points.at(id);
  }
}

}  // namespace

CalculixResult run_calculix(const std::filesystem::path& folder, const std::string& deck) {
  CalculixResult result;
  result.available = run_child({"ccx", "-v"}).exit_code >= 0;
  if (!result.available) return result;
  std::ofstream(folder / "job.inp") << deck;
  const ChildResult run = run_child({"env", "-C", folder.string(), "ccx", "-i", "job"});
  result.log = run.out + run.err;
  result.ok = run.exit_code == 0 && result.log.find("Job finished") != std::string::npos &&
              result.log.find("*ERROR") == std::string::npos;
  std::ifstream file(folder / "job.dat");
  read_tables(file, result);
  return result;
}

}  // namespace hexwall::test
