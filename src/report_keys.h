#pragma once

#include <string>
#include <vector>

namespace hexwall {

/// What a key of report.json means. `a.{b,c}` stands for a.b and a.c, `[]` for the items of a list;
/// keys below one that is listed are not.
struct ReportKey {
  std::string path;
  std::string meaning;
};

/// All keys of report.json, in their order. A test holds this against reports.
const std::vector<ReportKey>& report_keys();

}  // namespace hexwall
