#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/plot/curve_frame.hpp"
#include "finding.hpp"
#include "io/text/csv.hpp"
#include "problems/load_at.hpp"
#include "runs.hpp"
#include "sections.hpp"

namespace perilink::verification {
namespace {

/// Points of load over deflection where the load is larger than ever before, a few hundred.
std::vector<CurvePoint> rising_curve(const BarRun& run, double load_factor) {
  std::vector<CurvePoint> curve{{0.0, 0.0}};
  const double step = run.rows.back().displacement / 400.0;
  double largest = 0.0, furthest = 0.0;
  for (const CurveRow& row : run.rows) {
    if (row.displacement < furthest) continue;
    furthest = row.displacement;
    largest = std::max(largest, row.load);
    if (furthest - curve.back().displacement < step) continue;
    curve.push_back({furthest, load_factor * largest});
  }
  return curve;
}

/// Strain of the bar where it is largest, in the loaded state that is nearest to a load.
double steel_strain_at(const BarRun& run, double load) {
  double strain = 0.0, nearest = 1e30, largest = 0.0;
  std::size_t row = 0;
  for (const BarFrame& frame : run.frames) {
    for (; row <= frame.row; ++row) largest = std::max(largest, run.rows[row].load);
    const double at = run.rows[frame.row].load;
    if (at < 0.97 * largest || std::abs(at - load) > nearest) continue;
    nearest = std::abs(at - load);
    strain = most_strained(frame).strain * load / at;
  }
  return strain;
}

void draw_curves(const std::vector<CurvePoint>& computed, const std::vector<CurvePoint>& measured) {
  std::vector<CurvePoint> all = computed;
  all.insert(all.end(), measured.begin(), measured.end());
  const CurveFrame frame = make_curve_frame(all, 40.0);
  Svg svg(curve_figure_width, curve_figure_height);
  draw_axes(svg, frame.x, frame.y, "deflection (mm)", "load (kN)", Grid::lines);
  svg.path(curve_path(frame, computed), "fill=\"none\" stroke=\"#2f5d9b\" stroke-width=\"1.8\"");
  for (const CurvePoint& point : measured) {
    svg.circle({frame.x.map(point.displacement), frame.y.map(point.load)}, 4.0, "fill=\"#c1440e\"");
  }
  const char* style = "font-size=\"13\" fill=\"#333\"";
  svg.circle({485, 300}, 4.0, "fill=\"#c1440e\"");
  svg.text({498, 304.5}, "measured", "start", style);
  svg.line({475, 320}, {495, 320}, "stroke=\"#2f5d9b\" stroke-width=\"1.8\"");
  svg.text({498, 324.5}, "computed", "start", style);
  svg.save(PERILINK_STUDY_DIR "/measured_beam.svg");
}

}  // namespace

Findings bend_measured_beam() {
  const BarRun run = run_bars("measured_beam", changed_case("measured_beam", {}));
  // Half of the beam bears half of the load; kN.
  const std::vector<CurvePoint> computed = rising_curve(run, 2e-3);
  std::vector<CurvePoint> measured;
  Findings findings;
  for (const auto& row : read_csv(PERILINK_STUDY_DIR "/measured.csv").rows) {
    measured.push_back({row[1], 1e-3 * row[0]});
    if (row[0] > 9e4 && row[0] < 1.9e5) {
      findings.push_back({"6", "beam of SSNL119",
                          fmt::format("steel strain at {:.1f} kN", 1e-3 * row[0]),
                          steel_strain_at(run, 0.5 * row[0]), row[2], 0.0});
    }
    findings.push_back({"6", "beam of SSNL119", fmt::format("load (kN) at {:.1f} mm", row[1]),
                        load_at(computed, row[1]), 1e-3 * row[0], 0.1});
  }
  draw_curves(computed, measured);
  return findings;
}

}  // namespace perilink::verification
