#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "finding.hpp"
#include "runs.hpp"
#include "sections.hpp"

namespace perilink::verification {
namespace {

/// Stress over strain of the law without stress across, integrated over all directions of bonds:
/// verification/studies/concrete/reference.csv.
std::vector<std::array<double, 2>> integrated_law() {
  std::ifstream file(PERILINK_SOURCE_DIR "/verification/studies/concrete/reference.csv");
  std::vector<std::array<double, 2>> curve{{0.0, 0.0}};
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with("A,free,")) continue;
    std::istringstream text(line.substr(7));
    std::array<double, 2> point{};
    double across = 0.0;
    char comma = 0;
    text >> point[0] >> comma >> across >> comma >> point[1];
    curve.push_back(point);
  }
  std::sort(curve.begin(), curve.end());
  return curve;
}

}  // namespace

Findings crush_over_reinforced() {
  const Section section{100.0, 160.0, 130.0, 600.0, 200e3, 24850.0, 500.0};
  const BarRun run = run_bars("crushing", changed_case("crushing", {}));
  const CrushingMoment exact = crushing_moment(section, integrated_law());
  // Both couples have forces 160 mm apart, and the load is the sum of the two at one end.
  const double arm = 80.0;
  std::size_t peak = 0;
  for (std::size_t k = 0; k < run.rows.size(); ++k) {
    if (run.rows[k].load > run.rows[peak].load) peak = k;
  }
  const BarFrame* at_peak = &run.frames.front();
  for (const BarFrame& frame : run.frames) {
    if (frame.row <= peak) at_peak = &frame;
  }
  const double moment = run.rows[peak].load * arm;
  const double scale = run.rows[peak].load / run.rows[at_peak->row].load;
  Findings findings;
  findings.push_back({"5", "over-reinforced", "largest moment", moment, exact.moment, 0.1});
  findings.push_back({"5", "over-reinforced", "steel stress there",
                      most_strained(*at_peak).stress * scale, exact.steel_stress, 0.1});
  draw_run(run, "crushing.svg");
  return findings;
}

namespace {

constexpr const char* stirrups = R"(
[[rebar]]
inside = "beam"
along = "x"
cover = 30
spacing = 90
youngs_modulus = 200e3
area = 157
yield_strength = 500
)";

std::size_t row_of_peak(const BarRun& run) {
  std::size_t peak = 0;
  for (std::size_t k = 0; k < run.rows.size(); ++k) {
    if (run.rows[k].load > run.rows[peak].load) peak = k;
  }
  return peak;
}

/// Where a body gives way first: the largest load of a tenth of a millimetre of displacement that
/// no load of the next half reaches to nine tenths.
CurveRow first_failure(const BarRun& run) {
  std::vector<CurveRow> largest(static_cast<std::size_t>(10.0 * run.rows.back().displacement) + 2);
  for (const CurveRow& row : run.rows) {
    CurveRow& at = largest[static_cast<std::size_t>(10.0 * row.displacement)];
    if (row.load > at.load) at = row;
  }
  for (std::size_t k = 0; k + 5 < largest.size(); ++k) {
    double next = 0.0;
    for (std::size_t m = k + 1; m <= k + 5; ++m) next = std::max(next, largest[m].load);
    if (next < 0.9 * largest[k].load) return largest[k];
  }
  return {};
}

/// Moment in the segment that yields first, then.
double hinge_moment(const BarRun& run, double yield_strain) {
  for (const BarFrame& frame : run.frames) {
    const Segment& hinge = most_strained(frame);
    if (hinge.strain < 1.03 * yield_strain) continue;
    return 0.5 * largest_load(run, frame.row) * (500.0 - std::abs(hinge.x));
  }
  return 0.0;
}

}  // namespace

Findings shear_short_beams() {
  const Section section{150.0, 240.0, 200.0, 804.0, 200e3, 30e3, 500.0};
  // EN 1992-1-1, 6.2.2 with C = 0.18: k = 2, ratio of the steel 0.02 at most, both halves.
  const double shear = 2.0 * 0.18 * 2.0 * std::cbrt(100.0 * 0.02 * 38.0) * 150.0 * 200.0;
  Findings findings;
  for (const bool held : {false, true}) {
    const std::string body = held ? "short beam with stirrups" : "short beam without stirrups";
    const std::string label = held ? "stirrups" : "no_stirrups";
    const BarRun run = run_bars(label, changed_case("short_beam", {}) + (held ? stirrups : ""));
    const auto add = [&](const std::string& quantity, double measured, double reference = 0.0,
                         double allowed = 0.0) {
      findings.push_back({"5", body, quantity, measured, reference, allowed});
    };
    if (held) {
      add("moment in the hinge at yield", hinge_moment(run, 500.0 / 200e3), yield_moment(section),
          0.05);
      draw_run(run, "stirrups.svg", 10.0);
    } else {
      const CurveRow failure = first_failure(run);
      add("load at the first failure", failure.load, shear);
      add("the same over the load of yield at mid-span", failure.load,
          2.0 * yield_moment(section) / 500.0);
      add("displacement there", failure.displacement);
      draw_run(run, "no_stirrups.svg", 20.0, failure.displacement);
    }
    const CurveRow& last = run.rows[row_of_peak(run)];
    add("largest load up to 12 mm", last.load);
  }
  return findings;
}

}  // namespace perilink::verification
