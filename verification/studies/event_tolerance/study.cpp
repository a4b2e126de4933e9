#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <iterator>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "analysis/quasistatic/load_curve.hpp"
#include "io/case/case_file.hpp"
#include "model/from_case/configure.hpp"
#include "problems/block.hpp"
#include "problems/program.hpp"
#include "problems/result.hpp"

/// \file
/// Runs cases with several event tolerances and compares each run with the exact one.

namespace perilink::verification {
namespace {

struct Scene {
  const char* name;
  const char* file;  ///< relative to the folder of the study
};

constexpr Scene scenes[] = {
    {"plate with hole", "../../../meshes/softening_plate.toml"},
    {"beam with half notch", "half_notch.toml"},
    {"micropolar beam", "micropolar.toml"},
    {"cracked strip", "cracked_strip.toml"},
    {"mixed-mode beam", "mixed_mode_beam.toml"},
    {"peeled joint", "../../../meshes/peeled_joint.toml"},
    {"reinforced beam", "reinforced_beam.toml"},
    {"prism in space", "../../../meshes/notched_prism.toml"},
    {"notched beam", "notched_beam.toml"},
    {"L-panel", "../../../meshes/l_panel.toml"},
};
constexpr double tolerances[] = {0.0, 0.005, 0.01, 0.02, 0.05};

/// Windows of the envelope, and the part of the peak at which the comparison ends.
constexpr double windows = 120.0, last_part = 0.2;

struct Run {
  DamageResult result;
  std::vector<StepRecord> rows;
  double seconds = 0.0;  ///< processor time, calibration included
};

Run run_scene(const Scene& scene, double tolerance) {
  const std::clock_t start = std::clock();
  CaseFile input = read_case_file(std::string(PERILINK_STUDY_DIR) + "/" + scene.file);
  input.analysis.event_tolerance = tolerance;
  RowRecorder recorder;
  Run run;
  run.result = run_damage_analysis(build_model(input), damage_options(input, 1), recorder);
  run.rows = std::move(recorder.rows);
  run.seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  return run;
}

double events_of(const StepRecord& row) { return row.broken_bonds + row.yield_events; }

double compliance_of(const StepRecord& row) { return row.displacement / row.load; }

double compliance_of(const CurvePoint& point) { return point.displacement / point.load; }

/// The program's envelope over windows of equal numbers of events, which rows of batches do not
/// count.
std::vector<CurvePoint> envelope_of(const std::vector<StepRecord>& rows) {
  const std::vector<CurvePoint> path = event_path(rows);
  std::vector<CurvePoint> envelope;
  const double first = events_of(rows.front()), last = events_of(rows.back());
  std::size_t begin = 0;
  for (double window = 1.0; window <= windows; ++window) {
    const double wanted = first + (last - first) * window / windows;
    std::size_t end = begin;
    while (end + 1 < path.size() && events_of(rows[end]) < wanted) ++end;
    if (end == begin) continue;
    const auto of_window = std::span(path).subspan(begin, end - begin + 1);
    for (const CurvePoint& point : smooth_envelope(of_window, path.size())) {
      envelope.push_back(point);
    }
    begin = end;
  }
  return envelope;
}

/// Linear between the points of a table whose keys grow, constant beyond them.
template <class Row, class Key, class Value>
double value_at(const std::vector<Row>& rows, double key, Key key_of, Value value_of) {
  const auto next =
      std::find_if(rows.begin(), rows.end(), [&](const Row& row) { return key_of(row) >= key; });
  if (next == rows.begin()) return value_of(rows.front());
  if (next == rows.end()) return value_of(rows.back());
  const Row& before = *(next - 1);
  const double part = (key - key_of(before)) / (key_of(*next) - key_of(before));
  return value_of(before) + part * (value_of(*next) - value_of(before));
}

double peak_of(const std::vector<CurvePoint>& envelope) {
  return std::ranges::max_element(envelope, {}, &CurvePoint::load)->load;
}

struct Difference {
  double smooth_peak = 0.0, dissipated = 0.0, curve = 0.0;
};

/// At the compliance at which the load of the exact run has fallen to last_part of its peak.
Difference compare(const Run& exact, const Run& run) {
  const auto compliance = [](const auto& row) { return compliance_of(row); };
  const std::vector<CurvePoint> expected = envelope_of(exact.rows), found = envelope_of(run.rows);
  const double peak = peak_of(expected);
  const auto top = std::ranges::max_element(expected, {}, &CurvePoint::load);
  auto end = std::find_if(top, expected.end(),
                          [&](const CurvePoint& point) { return point.load < last_part * peak; });
  if (end == expected.end()) --end;
  const double last = std::min(compliance_of(*end), compliance_of(run.rows.back()));
  const auto energy = [](const StepRecord& row) { return row.dissipated_energy; };
  const double in_exact = value_at(exact.rows, last, compliance, energy);
  Difference difference;
  difference.smooth_peak = peak_of(found) / peak - 1.0;
  difference.dissipated = value_at(run.rows, last, compliance, energy) / in_exact - 1.0;
  double sum = 0.0, count = 0.0;
  for (const CurvePoint& point : expected) {
    if (compliance_of(point) > last) continue;
    const double load = value_at(found, compliance_of(point), compliance,
                                 [](const CurvePoint& at) { return at.load; });
    sum += std::abs(load - point.load);
    ++count;
  }
  difference.curve = sum / count / peak;
  return difference;
}

std::string row_of(const Scene& scene, double tolerance, const Run& exact, const Run& run) {
  const StepRecord &last = run.rows.back(), &expected = exact.rows.back();
  std::string differences;
  if (last.stage == 0) {
    const Difference difference = compare(exact, run);
    differences = fmt::format("{:.5f},{:.5f},{:.5f}", difference.smooth_peak, difference.dissipated,
                              difference.curve);
  } else {  // at the load of the end
    differences =
        fmt::format(",{:.5f},{:.5f}", last.dissipated_energy / expected.dissipated_energy - 1.0,
                    std::abs(last.displacement / expected.displacement - 1.0));
  }
  return fmt::format("{},{},{:.2f},{},{},{:.6g},{:.6g},{:.6g},{:.6g},{:.1e},{},{}\n", scene.name,
                     tolerance, run.seconds, run.rows.size(), events_of(last), run.result.peak_load,
                     last.displacement, last.dissipated_energy, last.released_energy,
                     run.result.energy_error, last.factorizations, differences);
}

}  // namespace
}  // namespace perilink::verification

/// What batches of events save and change: writes result.csv. `event_tolerance small` leaves out
/// the notched beam and the L-panel.
bool perilink::verification::run_program(const std::vector<std::string>& arguments) {
  const bool small = !arguments.empty() && arguments[0] == "small";
  std::string table =
      "scene,event_tolerance,seconds,rows,events,peak_load,end_displacement,dissipated_energy,"
      "released_energy,energy_error,factorizations,smooth_peak_difference,dissipated_difference,"
      "curve_difference\n";
  for (const Scene& scene : std::span(scenes).first(small ? 8 : std::size(scenes))) {
    const Run exact = run_scene(scene, 0.0);
    for (const double tolerance : tolerances) {
      const Run run = tolerance == 0.0 ? exact : run_scene(scene, tolerance);
      const std::string row = row_of(scene, tolerance, exact, run);
      fmt::print("{}", row);
      std::fflush(stdout);
      table += row;
    }
  }
  if (!small) write_result(PERILINK_STUDY_DIR, table);
  return true;
}
