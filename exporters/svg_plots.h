#pragma once

#include <string>
#include <vector>

#include "inspect/distribution.h"

namespace hexwall {

/// A histogram as an SVG element for a page: bars over an axis with round numbers.
/// \param at a value that is marked, such as the ideal one.
std::string svg_histogram(const Histogram& histogram, const std::string& axis, double at);

/// Values over their number as an SVG element: a line with a dot for each.
std::string svg_curve(const std::vector<double>& values, const std::string& axis,
                      const std::string& value_axis);

/// `text` with the characters that HTML and SVG reserve written as entities.
std::string html_text(const std::string& text);

}  // namespace hexwall
