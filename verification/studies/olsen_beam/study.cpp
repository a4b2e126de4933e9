#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "analysis/quasistatic/load_curve.hpp"
#include "app/plot/curve_frame.hpp"
#include "io/case/case_file.hpp"
#include "io/text/csv.hpp"
#include "model/from_case/configure.hpp"
#include "problems/block.hpp"
#include "problems/load_at.hpp"
#include "problems/program.hpp"
#include "problems/result.hpp"

namespace perilink::verification {
namespace {

/// The case with another spacing, model and strength.
std::string case_text(double spacing, const std::string& model, double strength) {
  std::ifstream file(PERILINK_STUDY_DIR "/olsen_beam.toml");
  std::string text{std::istreambuf_iterator<char>(file), {}};
  const auto replace = [&](const std::string& key, const std::string& value) {
    for (std::size_t at = 0; (at = text.find("\n" + key + " = ", at)) != std::string::npos; ++at) {
      text.replace(at, text.find('\n', at + 1) - at,
                   value.empty() ? "" : "\n" + key + " = " + value);
    }
  };
  replace("spacing", fmt::format("{}", spacing));
  replace("model", "\"" + model + "\"");
  replace("tensile_strength", fmt::format("{}", strength));
  if (model == "bond_based") replace("poissons_ratio", "");
  return text;
}

struct Run {
  std::string name, color;
  std::vector<CurvePoint> curve;  ///< envelope of the events
};

CurvePoint peak_of(const std::vector<CurvePoint>& curve) {
  return *std::max_element(curve.begin(), curve.end(),
                           [](const auto& a, const auto& b) { return a.load < b.load; });
}

std::vector<CurvePoint> measured_curve() {
  std::vector<CurvePoint> curve;
  for (const auto& row : read_csv(PERILINK_STUDY_DIR "/measured.csv").rows) {
    curve.push_back({row[0], row[1]});
  }
  return curve;
}

std::vector<CurvePoint> run_beam(double spacing, const std::string& model, double strength) {
  const CaseFile input = parse_case(case_text(spacing, model, strength), "olsen_beam.toml");
  RowRecorder recorder;
  run_damage_analysis(build_model(input), damage_options(input, 1), recorder);
  const std::vector<CurvePoint> path = event_path(recorder.rows);
  std::vector<CurvePoint> envelope = smooth_envelope(path, envelope_window(path.size()));
  envelope.insert(envelope.begin(), {0.0, 0.0});
  return envelope;
}

void draw(const std::vector<Run>& runs) {
  std::vector<CurvePoint> all;
  for (const Run& run : runs) all.insert(all.end(), run.curve.begin(), run.curve.end());
  const CurveFrame frame = make_curve_frame(all, 40.0);
  Svg svg(curve_figure_width, curve_figure_height);
  draw_axes(svg, frame.x, frame.y, "deflection (mm)", "load (N)", Grid::lines);
  SvgPoint key{480, 80};
  for (const Run& run : runs) {
    const std::string style = fmt::format("stroke=\"{}\" stroke-width=\"1.8\"", run.color);
    svg.path(curve_path(frame, run.curve), "fill=\"none\" " + style);
    svg.line(key, {key.x + 30, key.y}, style);
    svg.text({key.x + 38, key.y + 4.5}, run.name, "start", "font-size=\"13\" fill=\"#333\"");
    key.y += 20;
  }
  svg.save(PERILINK_STUDY_DIR "/load_deflection.svg");
}

}  // namespace

/// The notched beam of Olsen: writes result.csv and load_deflection.svg.
bool run_program(const std::vector<std::string>& /*arguments*/) {
  const std::vector<CurvePoint> measured = measured_curve();
  std::vector<Run> runs{{"measured", "#222", measured}};
  std::string table = "model,spacing,tensile_strength,peak_load,peak_deflection,mean_difference\n";
  const auto add = [&](double spacing, const std::string& model, double strength,
                       const char* color) {
    Run run{fmt::format("{}, {:.2g} mm", model, spacing), color,
            run_beam(spacing, model, strength)};
    double difference = 0.0, length = 0.0;
    for (std::size_t k = 1; k < measured.size(); ++k) {
      const double step = measured[k].displacement - measured[k - 1].displacement;
      if (measured[k].displacement > run.curve.back().displacement) break;
      difference +=
          step * std::abs(load_at(run.curve, measured[k].displacement) - measured[k].load);
      length += step;
    }
    const CurvePoint peak = peak_of(run.curve);
    table += fmt::format("{},{:.4g},{},{:.0f},{:.4f},{:.4f}\n", model, spacing, strength, peak.load,
                         peak.displacement, difference / length / peak_of(measured).load);
    fmt::print("{}", table);
    runs.push_back(std::move(run));
  };
  add(5.0, "micropolar", 2.7, "#2f5d9b");
  add(10.0 / 3.0, "micropolar", 2.7, "#3d7d3a");
  add(5.0, "bond_based", 2.7, "#c1440e");
  write_result(PERILINK_STUDY_DIR, table);
  draw(runs);
  return true;
}

}  // namespace perilink::verification
