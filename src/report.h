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
  int vertices = 0, faces = 0;      ///< of the surface that was read
  const PrepareResult* prepared;    ///< what was meshed, and how it came about
  std::vector<StageTime> io_times;  ///< reading and writing
};

/// The report of a run, `report.json`. README.md documents the keys. Lengths are in the unit of the
/// input. The keys `seconds` and `peak_memory_bytes` alone differ between equal runs.
nlohmann::ordered_json make_report(const PipelineResult& result, const ReportContext& context);

/// What was done to a surface before it was meshed; part of the report.
nlohmann::ordered_json preparation_json(const PrepareResult& prepared);

/// A few lines for people.
std::string summary(const PipelineResult& result, const std::string& units);

/// Greatest resident memory of this process so far, in bytes.
long peak_memory_bytes();

/// The version of the program, as in `hexwall --version`.
std::string version();

}  // namespace hexwall
