#include "exporters/svg_plots.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace hexwall {
namespace {

constexpr double width = 420.0;
constexpr double height = 230.0;
constexpr double left = 52.0;
constexpr double right = 14.0;
constexpr double top = 14.0;
constexpr double bottom = 46.0;

/// From values to places in the picture.
struct Axes {
  double low_x, high_x, low_y, high_y;

  double x(double value) const {
    return left + (width - left - right) * (value - low_x) / (high_x - low_x);
  }
  double y(double value) const {
    return height - bottom - (height - top - bottom) * (value - low_y) / (high_y - low_y);
  }
};

// 1, 2 or 5 times a power of ten, such that there are at most `most` steps.
double round_step(double range, int most) {
  const double least = range / most;
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= least * (1.0 - 1e-9)) return factor * power;
  }
  return 10.0 * power;
}

std::vector<double> ticks(double low, double high, int most) {
  const double step = round_step(high - low, most);
  const double first = std::ceil(low / step - 1e-9);
  const double last = std::floor(high / step + 1e-9);
  std::vector<double> values;
  for (int i = 0; i <= static_cast<int>(last - first); ++i) values.push_back((first + i) * step);
  return values;
}

std::string number(double value) {
  return fmt::format("{:g}", std::abs(value) < 1e-12 ? 0.0 : value);
}

std::string label(double x, double y, const char* anchor, const std::string& text) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", x, y, anchor,
                     html_text(text));
}

std::string line(double x0, double y0, double x1, double y1, const char* kind) {
  return fmt::format(
      "<line class=\"{}\" x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\"/>\n", kind, x0,
      y0, x1, y1);
}

std::string open_plot(const Axes& axes, const std::string& axis, const std::string& value_axis) {
  std::string svg =
      fmt::format("<svg class=\"plot\" viewBox=\"0 0 {:g} {:g}\" role=\"img\">\n", width, height);
  for (const double value : ticks(axes.low_x, axes.high_x, 8)) {
    const double x = axes.x(value);
    svg += line(x, height - bottom, x, height - bottom + 4.0, "axis");
    svg += label(x, height - bottom + 17.0, "middle", number(value));
  }
  for (const double value : ticks(axes.low_y, axes.high_y, 5)) {
    const double y = axes.y(value);
    svg += line(left, y, width - right, y, "grid");
    svg += label(left - 6.0, y + 4.0, "end", number(value));
  }
  svg += line(left, height - bottom, width - right, height - bottom, "axis");
  svg += label(0.5 * (left + width - right), height - 8.0, "middle", axis);
  svg += fmt::format(
      "<text transform=\"translate(12 {:.1f}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
      0.5 * (top + height - bottom), html_text(value_axis));
  return svg;
}

}  // namespace

std::string html_text(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string svg_histogram(const Histogram& h, const std::string& axis, double at) {
  const auto bins = static_cast<double>(h.counts.size());
  const double bin = h.width > 0.0 ? h.width : 1.0;  // all values are equal: one bar
  std::size_t greatest = 1;
  std::size_t total = 0;
  for (const std::size_t count : h.counts) {
    greatest = std::max(greatest, count);
    total += count;
  }
  const auto percent = [&](std::size_t count) {
    return 100.0 * static_cast<double>(count) /
           static_cast<double>(std::max<std::size_t>(1, total));
  };
  const Axes axes{h.low, h.low + bins * bin, 0.0, 1.05 * percent(greatest)};
  std::string svg = open_plot(axes, axis, "%");
  for (std::size_t i = 0; i < h.counts.size(); ++i) {
    if (h.counts[i] == 0) continue;
    const double x0 = axes.x(h.low + static_cast<double>(i) * bin);
    const double x1 = axes.x(h.low + static_cast<double>(i + 1) * bin);
    const double y = axes.y(percent(h.counts[i]));
    svg += fmt::format(
        "<rect class=\"bar\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\">"
        "<title>{}: {}</title></rect>\n",
        x0 + 0.5, y, std::max(0.5, x1 - x0 - 1.0), height - bottom - y,
        number(h.low + static_cast<double>(i) * bin), h.counts[i]);
  }
  if (at >= axes.low_x && at <= axes.high_x) {
    svg += line(axes.x(at), top, axes.x(at), height - bottom, "mark");
  }
  return svg + "</svg>\n";
}

std::string svg_curve(const std::vector<double>& values, const std::string& axis,
                      const std::string& value_axis) {
  if (values.empty()) return {};
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  const double range = std::max(*greatest - *least, 1e-3 * std::max(1e-9, std::abs(*greatest)));
  const Axes axes{0.0, std::max(1.0, static_cast<double>(values.size() - 1)), *least - 0.05 * range,
                  *greatest + 0.05 * range};
  std::string svg = open_plot(axes, axis, value_axis);
  std::string path;
  std::string dots;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double x = axes.x(static_cast<double>(i));
    const double y = axes.y(values[i]);
    path += fmt::format("{:.1f},{:.1f} ", x, y);
    dots += fmt::format(
        "<circle class=\"dot\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\"><title>{}: {:.6g}</title>"
        "</circle>\n",
        x, y, i, values[i]);
  }
  return svg + "<polyline class=\"curve\" points=\"" + path + "\"/>\n" + dots + "</svg>\n";
}

}  // namespace hexwall
