#include "app/scan/scan_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "app/plot/plot_axes.hpp"
#include "app/plot/plot_lines.hpp"
#include "app/scan/scan_table.hpp"
#include "base/types.hpp"

namespace perilink {
namespace {

/// Most members with a name each, where no key has several numbers, and their longest name.
constexpr std::size_t most_named = 12, longest_name = 40;

/// Labels of axes that count members.
constexpr const char *by_member = "member", *number_of_members = "members";

constexpr double scan_left = 92.0, scan_right = 640.0;
constexpr double scan_top = 62.0, scan_height = 560.0;

/// Returns the first key that has several numbers and nothing else; empty: none.
std::string varied_number(const ScanFile& scan) {
  for (const std::string& key : scan.keys) {
    std::set<double> numbers;
    const bool only_numbers =
        std::all_of(scan.members.begin(), scan.members.end(), [&](const ScanMember& member) {
          const TomlValue* value = member.find(key);
          if (value == nullptr) return false;
          numbers.insert(value->number);
          return value->kind == TomlValue::Kind::number || value->kind == TomlValue::Kind::integer;
        });
    if (only_numbers && numbers.size() > 1) return key;
  }
  return "";
}

/// Returns the line of a name, which is added where it is new.
ScanPlot::Line& line_of(ScanPlot& plot, const std::string& name) {
  const auto found = std::find_if(plot.lines.begin(), plot.lines.end(),
                                  [&](const ScanPlot::Line& line) { return line.name == name; });
  return found != plot.lines.end() ? *found : plot.lines.emplace_back(ScanPlot::Line{name, {}});
}

/// Returns an axis over the data alone, with margins.
Axis axis_of_data(double low, double high, double pixel_low, double pixel_high) {
  const double room = high > low ? 0.06 * (high - low) : std::max(0.5 * std::abs(low), 1e-9);
  return {low - room, high + room, pixel_low, pixel_high};
}

/// Returns the outline of a histogram with bins of one width.
std::vector<ScanPlot::Point> outline_of(std::span<const double> values, double low, double width,
                                        std::size_t bins) {
  std::vector<double> counts(bins, 0.0);
  for (const double value : values) {
    const double at = std::floor((value - low) / width);
    counts[static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(bins - 1)))] += 1.0;
  }
  std::vector<ScanPlot::Point> points;
  for (std::size_t k = 0; k < bins; ++k) {
    const double left = low + width * static_cast<double>(k), right = left + width;
    points.insert(points.end(), {{left, 0.0}, {left, counts[k]}, {right, counts[k]}, {right, 0.0}});
  }
  return points;
}

/// Adds the histograms of samples, with common bins.
void add_histograms(std::span<const ScanSample> samples, ScanPlot& plot) {
  double low = infinity, high = -infinity;
  std::size_t most = 1;
  for (const ScanSample& sample : samples) {
    most = std::max(most, sample.values.size());
    for (const double value : sample.values) {
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  // The number of bins of Sturges (1926), over the range of all samples.
  const double bins = high > low ? 1.0 + std::ceil(std::log2(static_cast<double>(most))) : 1.0;
  const double width = high > low ? (high - low) / bins : std::max(0.1 * std::abs(low), 1e-9);
  if (high == low) low -= 0.5 * width;
  for (const ScanSample& sample : samples) {
    ScanPlot::Line& line = plot.lines.emplace_back(ScanPlot::Line{sample_text(sample), {}});
    if (sample.values.empty()) continue;
    line.points = outline_of(sample.values, low, width, static_cast<std::size_t>(bins));
    line.mean = sample.mean();
  }
}

}  // namespace

ScanPlot scan_plot(const ScanFile& scan, std::span<const ScanResult> results,
                   const std::string& units) {
  const bool breaks = std::any_of(results.begin(), results.end(), [](const ScanResult& result) {
    return !std::isnan(number_of(result.numbers, "peak_load"));
  });
  const std::string quantity = breaks ? "peak_load" : "strain_energy";
  const std::string key = varied_number(scan);
  const std::string force = breaks ? units.substr(0, units.find(',')) : "";
  ScanPlot plot;
  plot.title = scan.title;
  plot.x_label = key.empty() ? by_member : key;
  plot.y_label = breaks ? "peak load" : "strain energy";
  if (!force.empty()) plot.y_label += " (" + force + ")";
  if (!scan.seeds.empty()) {
    plot.x_label = std::exchange(plot.y_label, number_of_members);
    add_histograms(samples_of(scan, results, quantity), plot);
    return plot;
  }
  const bool is_named =
      !key.empty() || (results.size() <= most_named &&
                       std::ranges::all_of(scan.members, [](const ScanMember& member) {
                         return member_text(member.settings).size() <= longest_name;
                       }));
  for (std::size_t k = 0; k < results.size(); ++k) {
    const double value = number_of(results[k].numbers, quantity);
    std::vector<CaseSetting> others = scan.members[k].settings;
    std::erase_if(others, [&](const CaseSetting& other) { return other.key == key; });
    ScanPlot::Line& line = line_of(plot, is_named ? member_text(others) : "");
    if (!std::isfinite(value)) continue;
    line.points.push_back(
        {key.empty() ? static_cast<double>(k + 1) : scan.members[k].find(key)->number, value});
  }
  for (ScanPlot::Line& line : plot.lines) {
    std::stable_sort(line.points.begin(), line.points.end(),
                     [](const auto& a, const auto& b) { return a.x < b.x; });
  }
  return plot;
}

Svg draw_scan(const ScanPlot& plot) {
  ScanPlot::Point low{infinity, infinity}, high{-infinity, -infinity};
  for (const ScanPlot::Line& line : plot.lines) {
    for (const ScanPlot::Point& point : line.points) {
      low = {std::min(low.x, point.x), std::min(low.y, point.y)};
      high = {std::max(high.x, point.x), std::max(high.y, point.y)};
    }
  }
  if (low.x > high.x) low = high = {1.0, 1.0};  // no point is drawn
  Axis x = axis_of_data(low.x, high.x, scan_left, scan_right);
  Axis y = make_axis(low.y, high.y, scan_height - 72.0, scan_top);
  x.counts = plot.x_label == by_member;
  y.counts = plot.y_label == number_of_members;
  std::vector<MarkedLine> lines;
  for (const ScanPlot::Line& line : plot.lines) {
    MarkedLine& marked = lines.emplace_back(MarkedLine{line.name, {}, line.mean.has_value()});
    for (const ScanPlot::Point& point : line.points) {
      marked.points.push_back({x.map(point.x), y.map(point.y)});
    }
  }
  const SvgPoint room = room_of_lines(lines);
  Svg svg(scan_right + room.x, std::max(scan_height, scan_top + room.y));
  svg.text({scan_left, 32}, plot.title, "start",
           "font-size=\"18\" font-weight=\"bold\" fill=\"#222\"");
  draw_axes(svg, x, y, plot.x_label, plot.y_label, Grid::lines);
  for (const ScanPlot::Line& line : plot.lines) {
    if (!line.mean) continue;
    svg.line({x.map(*line.mean), y.map(low.y)}, {x.map(*line.mean), y.map(high.y)},
             "stroke=\"#444\" stroke-dasharray=\"5 4\"");
  }
  draw_marked_lines(svg, lines, {scan_right, scan_top});
  return svg;
}

}  // namespace perilink
