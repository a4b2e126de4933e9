#include "app/compare/plot_comparison.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "app/plot/plot_curve.hpp"

namespace perilink {
namespace {

constexpr double frame_top = 92.0;
constexpr double legend_top = 52.0;
constexpr double legend_row = 21.0;
constexpr std::size_t legend_letters = 98;  ///< most characters that fit in a line of the legend

/// Colours for colour-blind readers (Okabe & Ito 2008). The second line is dashed, for prints
/// without colour and for coinciding curves.
struct Look {
  const char* color;
  const char* dashes;
};
constexpr std::array<Look, 2> looks = {{{"#0072b2", ""}, {"#d55e00", " stroke-dasharray=\"7 4\""}}};

std::string strong(const Look& look) {
  return fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"2\" stroke-linejoin=\"round\"{}",
                     look.color, look.dashes);
}

std::string pale(const Look& look) {
  return fmt::format(
      "fill=\"none\" stroke=\"{}\" stroke-width=\"0.5\" stroke-opacity=\"0.35\" "
      "stroke-linejoin=\"round\"",
      look.color);
}

/// Returns the envelope of a long path of events, else no point.
std::vector<CurvePoint> envelope_of(const RunResult& result) {
  const std::size_t rows = rows_before_tail(points_of(result.records));
  const std::vector<CurvePoint> path =
      event_path_of(std::span(result.records).first(rows), result.labels);
  if (path.size() <= events_for_envelope) return {};
  return smooth_envelope(path, envelope_window(path.size()));
}

/// Returns the title both results share, else both names.
std::string heading_of(const RunResult& a, const RunResult& b) {
  const bool shared = a.labels.title == b.labels.title && a.labels.title != a.name;
  return shared ? a.labels.title : a.name + " and " + b.name;
}

/// Returns a legend entry, "coarse: Beam in bending, peak 12 kN at 0.3 mm". The title is left out
/// if the heading has it or if it does not fit.
std::string legend_text(const RunResult& result, const std::string& heading) {
  const StepRecord& peak = result.peak();
  const std::string end =
      fmt::format(", peak {} at {}", in_unit(short_number(peak.load), result.labels.force),
                  in_unit(short_number(peak.displacement), result.labels.length));
  const std::string& title = result.labels.title;
  const bool new_title = title != result.name && title != heading;
  const std::string full = result.name + (new_title ? ": " + title : "") + end;
  return full.size() > legend_letters ? result.name + end : full;
}

void draw_legend(Svg& svg, double left, const std::string& text, std::size_t number) {
  const double y = legend_top + legend_row * static_cast<double>(number);
  SvgPath sample;
  sample.move_to({left, y});
  sample.line_to({left + 36, y});
  svg.path(sample, strong(looks[number]));
  svg.text({left + 44, y + 4.5}, text, "start", "font-size=\"13\" fill=\"#333\"");
}

}  // namespace

Svg draw_comparison(const RunResult& a, const RunResult& b) {
  const std::array<const RunResult*, 2> results = {&a, &b};
  std::array<std::vector<CurvePoint>, 2> points = {points_of(a.records), points_of(b.records)};
  for (std::vector<CurvePoint>& curve : points) curve.resize(rows_before_tail(curve));
  std::vector<CurvePoint> all = points[0];
  all.insert(all.end(), points[1].begin(), points[1].end());
  const CurveFrame frame = make_curve_frame(all, frame_top);
  const bool one_unit = a.units == b.units;

  Svg svg(curve_figure_width, curve_figure_height);
  const std::string heading = heading_of(a, b);
  svg.text({frame.x.pixel_low, 30}, heading, "start",
           "font-size=\"18\" font-weight=\"bold\" fill=\"#222\"");
  draw_axes(svg, frame.x, frame.y, with_unit("displacement", one_unit ? a.labels.length : ""),
            with_unit("load", one_unit ? a.labels.force : ""), Grid::lines);
  const std::array<std::vector<CurvePoint>, 2> smooth = {envelope_of(a), envelope_of(b)};
  for (std::size_t k = 0; k < 2; ++k) {
    if (!smooth[k].empty()) svg.path(curve_path(frame, points[k]), pale(looks[k]));
  }
  for (std::size_t k = 0; k < 2; ++k) {
    svg.path(curve_path(frame, smooth[k].empty() ? points[k] : smooth[k]), strong(looks[k]));
  }
  for (std::size_t k = 0; k < 2; ++k) {
    svg.circle(frame.at(points[k][results[k]->peak_number()]), 4.5,
               fmt::format("fill=\"#fff\" stroke=\"{}\" stroke-width=\"2\"", looks[k].color));
    draw_legend(svg, frame.x.pixel_low, legend_text(*results[k], heading), k);
  }
  return svg;
}

}  // namespace perilink
