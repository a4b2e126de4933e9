#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "app/plot/curve_frame.hpp"
#include "finding.hpp"
#include "runs.hpp"
#include "sections.hpp"

namespace perilink::verification {
namespace {

/// Largest load before the first bond has broken: from there on there are cracks.
double cracking_load(const BarRun& run) {
  double largest = 0.0;
  for (const CurveRow& row : run.rows) {
    if (row.broken > 0.0) break;
    largest = std::max(largest, row.load);
  }
  return largest;
}

/// Largest load up to the first frame in which the first bar yields; bars yield in teeth that rise
/// 2.5 % above their strength.
double yielding_load(const BarRun& run, double yield_strain) {
  for (const BarFrame& frame : run.frames) {
    if (most_strained(frame).strain > 1.03 * yield_strain) return largest_load(run, frame.row);
  }
  return 0.0;
}

/// Stress of the bar in its most strained segment over M / (A_s z), of frames between cracking and
/// yielding whose load is no less than so much of the largest before.
struct StressRatio {
  double mean = 0.0, least = 1e9, most = 0.0;
};

StressRatio stress_ratio(const BarRun& run, double moment_of_load, const Section& section,
                         double from_load) {
  StressRatio ratio;
  int count = 0;
  for (const BarFrame& frame : run.frames) {
    const double load = run.rows[frame.row].load;
    const double stress = load * moment_of_load / (section.area * elastic_arm(section));
    if (largest_load(run, frame.row) < from_load || stress > 0.95 * section.yield) continue;
    const double part = most_strained(frame).stress / stress;
    if (most_strained(frame).strain > section.yield / section.steel) continue;
    ratio.mean += part;
    ratio.least = std::min(ratio.least, part);
    ratio.most = std::max(ratio.most, part);
    ++count;
  }
  ratio.mean /= count;
  return ratio;
}

const Section four_point_section{150.0, 240.0, 200.0, 157.0, 200e3, 30e3, 500.0};
constexpr double four_point_arm = 0.5 * 660.0;  // moment over the sum of both loads [mm]

/// Stress of the bar where it is largest over the load in kN, of loaded states.
std::vector<CurvePoint> stress_over_load(const BarRun& run) {
  std::vector<CurvePoint> points;
  for (const BarFrame& frame : run.frames) {
    const double load = run.rows[frame.row].load;
    if (load < 0.97 * largest_load(run, frame.row)) continue;
    points.push_back({1e-3 * load, most_strained(frame).stress});
  }
  return points;
}

void draw_stress(const std::vector<CurvePoint>& bond_based,
                 const std::vector<CurvePoint>& micropolar) {
  const Section& section = four_point_section;
  const double end = 1e-3 * yield_moment(section) / four_point_arm;
  std::vector<CurvePoint> all = bond_based;
  all.insert(all.end(), micropolar.begin(), micropolar.end());
  const CurveFrame frame = make_curve_frame(all, 40.0);
  Svg svg(curve_figure_width, curve_figure_height);
  draw_axes(svg, frame.x, frame.y, "load (kN)", "steel stress (MPa)", Grid::lines);
  const char* style = "stroke=\"#222\" stroke-width=\"1.4\"";
  svg.line({frame.x.map(0.0), frame.y.map(0.0)}, {frame.x.map(end), frame.y.map(section.yield)},
           style);
  const char* text = "font-size=\"13\" fill=\"#333\"";
  svg.line({105, 80}, {125, 80}, style);
  svg.text({132, 84.5}, "M / (A z), cracked", "start", text);
  double y = 100.0;
  for (const auto& [name, color, points] :
       {std::tuple{"bond-based", "#c1440e", &bond_based}, {"micropolar", "#2f5d9b", &micropolar}}) {
    const std::string fill = fmt::format("fill=\"{}\"", color);
    for (const CurvePoint& point : *points) {
      svg.circle({frame.x.map(point.displacement), frame.y.map(point.load)}, 3.0, fill);
    }
    svg.circle({115, y}, 3.0, fill);
    svg.text({132, y + 4.5}, name, "start", text);
    y += 20.0;
  }
  svg.save(PERILINK_STUDY_DIR "/steel_stress.svg");
}

std::vector<CurvePoint> bend(Findings& findings, const std::string& model) {
  const Section& section = four_point_section;
  const double arm = four_point_arm;
  Changes changes{{"model", "\"" + model + "\""}};
  if (model == "bond_based") changes.push_back({"poissons_ratio", ""});
  const BarRun run = run_bars("four_point_" + model, changed_case("four_point", changes));
  const auto add = [&](const std::string& quantity, double measured, double reference,
                       double allowed) {
    findings.push_back({"1", model, quantity, measured, reference, allowed});
  };
  const double modulus = uncracked_modulus(section);
  const double cracking = cracking_load(run) * arm;
  add("cracking moment, f_t in bending", cracking, 2.5 * model_code_bending_factor(240.0) * modulus,
      0.1);
  add("cracking moment, f_t in tension", cracking, 2.5 * modulus, 0.0);
  add("yield moment", yielding_load(run, 500.0 / 200e3) * arm, yield_moment(section), 0.05);
  const BarFrame& last = last_loaded_frame(run);
  const double strain = mean_strain(last, most_strained(last).distance, section.depth);
  add("last moment", largest_load(run, last.row) * arm, plastic_moment(section, strain), 0.03);
  add("mean strain of the steel there", strain, 0.0, 0.0);
  const StressRatio ratio = stress_ratio(run, arm, section, 1.3 * cracking_load(run));
  add("steel stress over M/(A z), mean", ratio.mean, 1.0, 0.05);
  add("steel stress over M/(A z), least", ratio.least, 1.0, 0.0);
  add("steel stress over M/(A z), most", ratio.most, 1.0, 0.0);
  if (model == "micropolar") draw_run(run, "four_point.svg");
  return stress_over_load(run);
}

}  // namespace

Findings bend_on_four_points() {
  Findings findings;
  const std::vector<CurvePoint> bond_based = bend(findings, "bond_based");
  draw_stress(bond_based, bend(findings, "micropolar"));
  return findings;
}

Findings push_cantilever() {
  const Section section{1.0, 100.0, 90.0, 3.0, 29000.0, 3604.0, 60.0};
  const BarRun run = run_bars("cantilever", changed_case("cantilever", {}));
  Findings findings;
  const auto add = [&](const std::string& quantity, double measured, double reference,
                       double allowed) {
    findings.push_back({"2", "cantilever", quantity, measured, reference, allowed});
  };
  // Moments are those in the section where the bar is strained most: the load acts at y = 225.
  const BarFrame& last = last_loaded_frame(run);
  const Segment hinge = most_strained(last);
  const double strain = mean_strain(last, hinge.distance, section.depth);
  add("height of the hinge", hinge.y, 0.0, 0.0);
  add("mean strain of the steel", strain, 0.0, 0.0);
  add("plastic moment", largest_load(run, last.row) * (225.0 - hinge.y),
      plastic_moment(section, strain), 0.03);
  for (const BarFrame& frame : run.frames) {
    if (most_strained(frame).strain < 1.03 * 60.0 / 29000.0) continue;
    add("first yield", largest_load(run, frame.row) * (225.0 - most_strained(frame).y),
        yield_moment(section), 0.05);
    break;
  }
  draw_run(run, "cantilever.svg", 4.0);
  return findings;
}

}  // namespace perilink::verification
