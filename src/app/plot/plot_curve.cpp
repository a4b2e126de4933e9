#include "app/plot/plot_curve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "app/plot/plot_axes.hpp"
#include "app/plot/plot_stages.hpp"

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

constexpr double legend_width = 222.0, line_height = 20.0;

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

/// Label of a peak.
struct PeakLabel {
  std::string text;
  SvgPoint peak, at;
  /// Whether the peak is in the left half of the plot; the text then runs to the right.
  bool left_half = true;

  Area area() const {
    // Letters are about 0.56 of their size wide.
    const double width = 0.56 * 14.0 * static_cast<double>(text.size());
    return {{left_half ? at.x : at.x - width, at.y - 14.0}, width, 20.0};
  }
};

PeakLabel label_of(const CurveFrame& frame, const char* name, const CurvePoint& peak,
                   const PlotLabels& labels) {
  PeakLabel label;
  label.text = fmt::format("{} {} at {}", name, in_unit(short_number(peak.load), labels.force),
                           in_unit(short_number(peak.displacement), labels.length));
  label.peak = frame.at(peak);
  label.left_half = label.peak.x < (frame.x.pixel_low + frame.x.pixel_high) / 2;
  label.at = {label.peak.x + (label.left_half ? 10.0 : -10.0),
              label.peak.y + (peak.load < 0.0 ? 20.0 : -8.0)};
  return label;
}

/// Returns the labels of the peak. Where the load rose again after failure, labels the first peak
/// and the largest load.
std::vector<PeakLabel> labels_of(const CurveFrame& frame, const StepRecord& peak,
                                 const std::optional<CurvePoint>& first_peak,
                                 const PlotLabels& labels) {
  const bool two = first_peak && std::abs(first_peak->load) < std::abs(peak.load);
  std::vector<PeakLabel> all = {
      label_of(frame, two ? "largest load" : "peak", {peak.displacement, peak.load}, labels)};
  if (two) {
    all.push_back(label_of(frame, "first peak", *first_peak, labels));
  }
  return all;
}

void mark_peak(Svg& svg, const PeakLabel& label) {
  svg.circle(label.peak, 4.5, "fill=\"#fff\" stroke=\"#b3202a\" stroke-width=\"2\"");
  svg.text(label.at, label.text, label.left_half ? "start" : "end",
           "font-size=\"14\" fill=\"#b3202a\" stroke=\"#fff\" stroke-width=\"4\" "
           "paint-order=\"stroke\"");
}

/// Returns the corner of the frame in which the legend covers no label and as little of the curve
/// as possible.
Area legend_area(const CurveFrame& frame, std::span<const PeakLabel> labels,
                 std::span<const CurvePoint> curve, std::size_t lines = 2) {
  constexpr double width = legend_width, margin = 2.0;
  const double height = 8.0 + line_height * static_cast<double>(lines);
  const double right = frame.x.pixel_high - width, left = frame.x.pixel_low + margin;
  const double top = frame.y.pixel_high + margin, bottom = frame.y.pixel_low - height - margin;
  Area best;
  std::size_t least = std::numeric_limits<std::size_t>::max();
  for (const SvgPoint corner :
       {SvgPoint{right, top}, {right, bottom}, {left, top}, {left, bottom}}) {
    const Area area{corner, width, height};
    std::size_t hidden = 0;
    for (const PeakLabel& label : labels) hidden += area.meets(label.area()) ? curve.size() + 1 : 0;
    for (const CurvePoint& point : curve) hidden += area.holds(frame.at(point));
    if (hidden >= least) continue;
    least = hidden;
    best = area;
  }
  return best;
}

/// Draws a note at the right end of the line of the axis label.
void draw_note(Svg& svg, const CurveFrame& frame, const std::string& note) {
  if (note.empty()) return;
  svg.text({frame.x.pixel_high, curve_figure_height - 12.0}, note, "end", note_style);
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
  svg.text({x + 40, y + 4.5}, "smoothed curve", "start", note_style);
  svg.text({x + 40, y + 24.5}, "events", "start", note_style);
}

}  // namespace

std::size_t peak_row(std::span<const StepRecord> records) {
  const auto peak = std::max_element(
      records.begin(), records.end(),
      [](const auto& a, const auto& b) { return std::abs(a.load) < std::abs(b.load); });
  return static_cast<std::size_t>(peak - records.begin());
}

std::vector<CurvePoint> points_of(std::span<const StepRecord> records) {
  std::vector<CurvePoint> points;
  for (const StepRecord& record : records) points.push_back({record.displacement, record.load});
  return points;
}

std::vector<CurvePoint> event_path_of(std::span<const StepRecord> records,
                                      const PlotLabels& labels) {
  const bool breaks_bonds = labels.analysis.empty() || labels.analysis == "damage";
  return breaks_bonds ? event_path(records) : std::vector<CurvePoint>{};
}

std::size_t rows_before_tail(std::span<const CurvePoint> curve) {
  constexpr double tail = 0.01;
  double peak = 0.0, reached = 0.0;
  for (const CurvePoint& row : curve) peak = std::max(peak, std::abs(row.load));
  std::size_t rows = curve.size();
  while (rows > 0 && std::abs(curve[rows - 1].load) < tail * peak) --rows;
  for (const CurvePoint& row : curve.first(rows)) {
    reached = std::max(reached, std::abs(row.displacement));
  }
  while (rows < curve.size() && std::abs(curve[rows].displacement) <= reached) ++rows;
  return rows;
}

std::size_t rows_before_drift(std::span<const CurvePoint> curve, const CurvePoint& peak) {
  constexpr double digits = 1e-6, far = 10.0;
  const auto load = [](const CurvePoint& row) { return std::abs(row.load); };
  const auto reached = [](std::span<const CurvePoint> rows) {
    double most = 0.0;
    for (const CurvePoint& row : rows) most = std::max(most, std::abs(row.displacement));
    return most;
  };
  const double highest = load(peak);
  const auto at = std::ranges::find_if(
      curve, [&](const CurvePoint& row) { return load(row) >= (1.0 - digits) * highest; });
  const auto above = std::find_if(
      at, curve.end(), [&](const CurvePoint& row) { return load(row) > (1.0 + digits) * highest; });
  if (above == curve.end()) return curve.size();
  const auto lowest = std::ranges::min_element(at, above, {}, load);
  const auto rows = static_cast<std::size_t>(lowest - curve.begin()) + 1;
  return reached(curve) > far * reached(curve.first(rows)) ? rows : curve.size();
}

std::string note_of_tail(std::size_t rows) {
  if (rows == 0) return "";
  return fmt::format("{} last row{} not drawn (--whole)", rows, rows == 1 ? "" : "s");
}

Svg draw_columns(const ColumnCurve& curve, const std::string& title) {
  const CurveFrame frame = make_curve_frame(curve.points, 62.0);
  Svg svg(curve_figure_width, curve_figure_height);
  svg.text({frame.x.pixel_low, 32}, title, "start", title_style);
  draw_axes(svg, frame.x, frame.y, curve.x_label, curve.y_label, Grid::lines);
  draw_note(svg, frame, curve.note);
  if (curve.points.empty()) return svg;
  svg.path(curve_path(frame, curve.points, curve.from_origin ? CurvePoint{} : curve.points.front()),
           few_events_style);
  return svg;
}

Svg draw_load_displacement(std::span<const StepRecord> records, const PlotLabels& labels,
                           const std::optional<CurvePoint>& first_peak,
                           std::optional<std::size_t> rows) {
  std::vector<CurvePoint> events = points_of(records);
  const std::size_t tail = events.size() - rows.value_or(rows_before_tail(events));
  records = records.first(records.size() - tail);
  events.resize(records.size());
  const CurveFrame frame = make_curve_frame(events, 62.0);
  Svg svg(curve_figure_width, curve_figure_height);
  svg.text({frame.x.pixel_low, 32}, labels.title, "start", title_style);
  draw_axes(svg, frame.x, frame.y, with_unit("displacement", labels.length),
            with_unit("load", labels.force), Grid::lines);
  draw_note(svg, frame, note_of_tail(tail));
  if (records.empty()) return svg;

  const std::vector<CurvePoint> path = event_path_of(records, labels);
  const std::vector<PeakLabel> peaks =
      labels_of(frame, records[peak_row(records)], first_peak, labels);
  if (const std::vector<StagePath> stages = paths_of_stages(records, labels); !stages.empty()) {
    const Area area = legend_area(frame, peaks, events, stages.size());
    svg.rect(area.corner, area.width, area.height, "fill=\"#fff\"");
    draw_stages(svg, frame, stages, {area.corner.x + 10.0, area.corner.y + 14.0}, line_height);
  } else if (path.size() > events_for_envelope) {
    svg.path(curve_path(frame, events), many_events_style);
    svg.path(curve_path(frame, smooth_envelope(path, envelope_window(path.size()))),
             envelope_style);
    draw_legend(svg, legend_area(frame, peaks, events));
  } else {
    svg.path(curve_path(frame, events), few_events_style);
  }
  for (const PeakLabel& peak : peaks) mark_peak(svg, peak);
  return svg;
}

}  // namespace perilink
