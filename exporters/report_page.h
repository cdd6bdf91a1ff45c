#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "exporters/view_data.h"
#include "pipeline.h"

namespace hexwall {

struct PagePicture {
  std::string name, caption;
  std::string png;  ///< the file's bytes
};

/// What a page has beyond numbers.
struct PageParts {
  std::vector<PagePicture> pictures;
  std::string pictures_note;     ///< why there are none; empty: nothing to say
  std::string_view view_script;  ///< of the 3-D view; empty: the program was built without it
  ViewData view;                 ///< what it shows
  std::string distributions;     ///< of `distribution_plots`
};

/// A section of the page: histograms of the quads and hexahedra. Takes a while on large meshes.
std::string distribution_plots(const PipelineResult& result);

/// `report.html`: a page that needs no other file and no network. Warnings come first. The element
/// with the id `times` alone differs between equal runs.
/// \param report of `make_report`.
std::string report_page(const PipelineResult& result, const nlohmann::ordered_json& report,
                        const PageParts& parts);

}  // namespace hexwall
