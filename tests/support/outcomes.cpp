#include "support/outcomes.h"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace hexwall::test {
namespace {

constexpr std::size_t columns = 13;

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(' ');
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(' ') - first + 1);
}

std::vector<std::string> cells_of(const std::string& row) {
  std::vector<std::string> cells;
  std::istringstream text(row.substr(1));
  for (std::string cell; std::getline(text, cell, '|');) cells.push_back(trimmed(cell));
  return cells;
}

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

Outcome outcome_of_cells(const std::vector<std::string>& c) {
  Outcome outcome;
  outcome.surface = c[0];
  outcome.vertices = std::stoi(c[1]);
  outcome.triangles = std::stoi(c[2]);
  outcome.untouched = c[3];
  outcome.options = words_of(c[4]);
  outcome.exit_code = std::stoi(c[5]);
  outcome.words = c[12];
  if (outcome.exit_code != 0) return outcome;
  outcome.counts = {std::stoi(c[6]), std::stoi(c[7]), std::stod(c[8]), std::stoi(c[9]),
                    std::stoi(c[10])};
  outcome.check_mesh = c[11];
  return outcome;
}

/// Rows of the table: lines that begin with '|', but for the heading and the rule below it.
std::vector<Outcome> read_outcomes() {
  std::ifstream file(HEXWALL_OUTCOMES);
  std::vector<Outcome> rows;
  int heading = 2;
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with('|') || heading-- > 0) continue;
    const std::vector<std::string> cells = cells_of(line);
    if (cells.size() != columns) throw std::runtime_error("outcomes.md: wrong columns: " + line);
    try {
      rows.push_back(outcome_of_cells(cells));
    } catch (const std::logic_error&) {  // of std::stoi
      throw std::runtime_error("outcomes.md: a number is missing: " + line);
    }
  }
  if (rows.empty()) throw std::runtime_error(HEXWALL_OUTCOMES " holds no table");
  return rows;
}

}  // namespace

std::ostream& operator<<(std::ostream& out, const MeshCounts& c) {
  return out << c.openings << " openings, " << c.poles << " poles, zeros of order " << c.order
             << ", " << c.half_zeros << " half-zeros, " << c.irregular << " irregular vertices";
}

void PrintTo(const Outcome& outcome, std::ostream* out) {
  *out << outcome.surface;
  for (const std::string& option : outcome.options) *out << ' ' << option;
}

const std::vector<Outcome>& outcomes() {
  static const std::vector<Outcome> rows = read_outcomes();
  return rows;
}

std::vector<Outcome> shared_files() {
  std::vector<Outcome> files;
  for (const Outcome& row : outcomes()) {
    const bool is_known = std::any_of(files.begin(), files.end(), [&](const Outcome& file) {
      return file.surface == row.surface;
    });
    if (row.is_shared() && !is_known) files.push_back(row);
  }
  return files;
}

const Outcome& outcome_of(const std::string& surface) {
  const auto row = std::find_if(outcomes().begin(), outcomes().end(),
                                [&](const Outcome& o) { return o.surface == surface; });
  if (row == outcomes().end()) throw std::runtime_error("outcomes.md has no row for " + surface);
  return *row;
}

}  // namespace hexwall::test
