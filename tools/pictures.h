#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "exporters/report_page.h"
#include "pipeline.h"

namespace hexwall {

/// Pictures of a run, or why there are none.
struct PictureResult {
  std::vector<PagePicture> pictures;
  std::string reason;
};

/// Takes all pictures with `hexwall-picture`, on an X server of its own (Xvfb) or, without that, on
/// the display there is. \param folder for the files that are needed meanwhile.
/// \param progress called with the number of the picture and of all before each one.
PictureResult take_pictures(const std::filesystem::path& folder, const PipelineResult& result,
                            const std::function<void(int, int)>& progress);

}  // namespace hexwall
