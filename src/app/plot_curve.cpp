#include "app/plot_curve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "app/plot_axes.hpp"

namespace perilink {
namespace {

constexpr const char* title_style = "font-size=\"18\" font-weight=\"bold\" fill=\"#222\"";
constexpr const char* note_style = "font-size=\"13\" fill=\"#444\"";
constexpr const char* envelope_style =
    "fill=\"none\" stroke=\"#0b3c6f\" stroke-width=\"2.4\" stroke-linejoin=\"round\" "
    "stroke-linecap=\"round\"";
constexpr const char* few_events_style =
    "fill=\"none\" stroke=\"#0b3c6f\" stroke-width=\"1.5\" stroke-linejoin=\"round\"";
constexpr const char* many_events_style =
    "fill=\"none\" stroke=\"#9dbfe0\" stroke-width=\"0.5\" stroke-linejoin=\"round\"";

/// Rectangle of the page [px].
struct Area {
  SvgPoint corner;  ///< upper left
  double width = 0.0, height = 0.0;

  bool holds(SvgPoint at) const {
    return at.x >= corner.x && at.x <= corner.x + width && at.y >= corner.y &&
           at.y <= corner.y + height;
  }
  bool meets(const Area& other) const {
    return corner.x < other.corner.x + other.width && other.corner.x < corner.x + width &&
           corner.y < other.corner.y + other.height && other.corner.y < corner.y + height;
  }
};

/// What stands beside the peak.
struct PeakLabel {
  std::string text;
  SvgPoint peak, at;
  bool left_half = true;  ///< of the picture; the text runs to the right then

  Area area() const {
    // Letters are about 0.56 of their size wide.
    const double width = 0.56 * 14.0 * static_cast<double>(text.size());
    return {{left_half ? at.x : at.x - width, at.y - 14.0}, width, 20.0};
  }
};

PeakLabel label_of(const CurveFrame& frame, const StepRecord& peak, const PlotLabels& labels) {
  PeakLabel label;
  label.text = fmt::format("peak {} at {}", in_unit(short_number(peak.load), labels.force),
                           in_unit(short_number(peak.displacement), labels.length));
  label.peak = frame.at({peak.displacement, peak.load});
  label.left_half = label.peak.x < (frame.x.pixel_low + frame.x.pixel_high) / 2;
  label.at = {label.peak.x + (label.left_half ? 10.0 : -10.0),
              label.peak.y + (peak.load < 0.0 ? 20.0 : -8.0)};
  return label;
}

void mark_peak(Svg& svg, const PeakLabel& label) {
  svg.circle(label.peak, 4.5, "fill=\"#fff\" stroke=\"#b3202a\" stroke-width=\"2\"");
  svg.text(label.at, label.text, label.left_half ? "start" : "end",
           "font-size=\"14\" fill=\"#b3202a\" stroke=\"#fff\" stroke-width=\"4\" "
           "paint-order=\"stroke\"");
}

/// The corner of the frame where the legend meets neither the label nor, as far as that is
/// possible, the curve.
Area legend_area(const CurveFrame& frame, const PeakLabel& label,
                 std::span<const CurvePoint> curve) {
  constexpr double width = 222.0, height = 48.0, margin = 2.0;
  const double right = frame.x.pixel_high - width, left = frame.x.pixel_low + margin;
  const double top = frame.y.pixel_high + margin, bottom = frame.y.pixel_low - height - margin;
  Area best;
  std::size_t least = std::numeric_limits<std::size_t>::max();
  for (const SvgPoint corner :
       {SvgPoint{right, top}, {right, bottom}, {left, top}, {left, bottom}}) {
    const Area area{corner, width, height};
    std::size_t hidden = area.meets(label.area()) ? curve.size() + 1 : 0;
    for (const CurvePoint& point : curve) hidden += area.holds(frame.at(point));
    if (hidden >= least) continue;
    least = hidden;
    best = area;
  }
  return best;
}

void draw_legend(Svg& svg, const Area& area) {
  const double x = area.corner.x + 10.0;
  const double y = area.corner.y + 14.0;
  svg.rect(area.corner, area.width, area.height, "fill=\"#fff\"");
  SvgPath smooth, events;
  smooth.move_to({x, y});
  smooth.line_to({x + 30, y});
  events.move_to({x, y + 20});
  for (int k = 0; k < 5; ++k) {
    events.line_to({x + 6.0 * k + 4.0, y + 15});
    events.line_to({x + 6.0 * k + 6.0, y + 24});
  }
  svg.path(smooth, envelope_style);
  svg.path(events, many_events_style);
  svg.text({x + 40, y + 4.5}, "envelope of equal energy", "start", note_style);
  svg.text({x + 40, y + 24.5}, "events", "start", note_style);
}

}  // namespace

std::size_t envelope_window(std::size_t events) { return std::max<std::size_t>(10, events / 120); }

std::vector<CurvePoint> smooth_envelope(std::span<const StepRecord> records, std::size_t window) {
  std::vector<CurvePoint> curve;
  const auto compliance = [&](std::size_t k) {
    return records[k].displacement / records[k].load_factor;
  };
  // Event k takes the compliance from row k to row k + 1, so the last row has none.
  for (std::size_t begin = 0; begin + 1 < records.size(); begin += window) {
    const std::size_t end = std::min(begin + window, records.size() - 1);
    double growth = 0.0, weighted = 0.0;
    CurvePoint mean;
    bool usable = records[end].load_factor != 0.0;
    for (std::size_t k = begin; k < end; ++k) {
      const StepRecord& record = records[k];
      mean.displacement += record.displacement / static_cast<double>(end - begin);
      mean.load += record.load / static_cast<double>(end - begin);
      usable = usable && record.load_factor != 0.0 && records[k + 1].load_factor != 0.0;
      if (!usable) continue;
      const double change = compliance(k + 1) - compliance(k);
      growth += change;
      weighted += record.load_factor * record.load_factor * change;
    }
    if (!usable || !(growth > 0.0) || !(weighted > 0.0)) {
      curve.push_back(mean);
      continue;
    }
    const double factor = std::copysign(std::sqrt(weighted / growth), records[begin].load_factor);
    const double reference_load = records[begin].load / records[begin].load_factor;
    const double middle = 0.5 * (compliance(begin) + compliance(end));
    curve.push_back({factor * middle, factor * reference_load});
  }
  return curve;
}

std::size_t peak_row(std::span<const StepRecord> records) {
  const auto peak = std::max_element(
      records.begin(), records.end(),
      [](const auto& a, const auto& b) { return std::abs(a.load) < std::abs(b.load); });
  return static_cast<std::size_t>(peak - records.begin());
}

Svg draw_load_displacement(std::span<const StepRecord> records, const PlotLabels& labels,
                           HistoryPath path) {
  std::vector<CurvePoint> events;
  events.reserve(records.size());
  for (const StepRecord& record : records) events.push_back({record.displacement, record.load});
  const CurveFrame frame = make_curve_frame(events, 62.0);
  Svg svg(curve_figure_width, curve_figure_height);
  svg.text({frame.x.pixel_low, 32}, labels.title, "start", title_style);
  draw_axes(svg, frame.x, frame.y, with_unit("displacement", labels.length),
            with_unit("load", labels.force), Grid::lines);
  if (records.empty()) return svg;

  const PeakLabel label = label_of(frame, records[peak_row(records)], labels);
  if (path == HistoryPath::events && records.size() > events_for_envelope) {
    // Where events snap back far the mean of a window can lie beyond all of them.
    svg.clip_rect("frame", {frame.x.pixel_low, frame.y.pixel_high},
                  frame.x.pixel_high - frame.x.pixel_low, frame.y.pixel_low - frame.y.pixel_high);
    svg.open_group("clip-path=\"url(#frame)\"");
    svg.path(curve_path(frame, events), many_events_style);
    const std::size_t window = envelope_window(records.size());
    svg.path(curve_path(frame, smooth_envelope(records, window)), envelope_style);
    svg.close_group();
    draw_legend(svg, legend_area(frame, label, events));
  } else {
    svg.path(curve_path(frame, events), few_events_style);
  }
  mark_peak(svg, label);
  return svg;
}

}  // namespace perilink
