#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "pipeline.h"

namespace hexwall {

/// What the report needs beside the pipeline's result.
struct ReportContext {
  std::string input_file;
  std::string units;                ///< mm, cm, m or um
  std::vector<std::string> notes;   ///< from reading
  std::vector<StageTime> io_times;  ///< reading and writing
};

/// The report of a run, `report.json`. README.md documents the keys. Lengths are in the unit of the
/// input. The keys `seconds` and `peak_memory_bytes` alone differ between equal runs.
nlohmann::ordered_json make_report(const PipelineResult& result, const ReportContext& context);

/// A few lines for people.
std::string summary(const PipelineResult& result, const std::string& units);

/// Greatest resident memory of this process so far, in bytes.
long peak_memory_bytes();

/// The version of the program, as in `hexwall --version`.
std::string version();

}  // namespace hexwall
