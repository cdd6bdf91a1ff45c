#pragma once

#include <string>
#include <string_view>

#include "exporters/output_file.h"

namespace hexwall {

/// The banner every OpenFOAM file begins with. `note` is left out if empty.
std::string foam_header(std::string_view foam_class, std::string_view location,
                        std::string_view object, std::string_view note = "");

/// A dictionary `folder`/`name` of a case.
OutputFile foam_dictionary(std::string_view folder, std::string_view name, std::string_view body);

}  // namespace hexwall
