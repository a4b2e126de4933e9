#include "problems/lattice_test.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <mutex>
#include <thread>

#include "base/error.hpp"
#include "base/timer.hpp"
#include "io/case/case_overrides.hpp"
#include "model/from_case/lattice_case.hpp"

namespace perilink::verification {
namespace {

/// Rows per run, at which energies are balanced and the forces of driven ends read: a few hundred
/// in every fundamental period, so that none misses the peak by more than a part in ten thousand.
/// Runs that only want the peak force of supports, which are asked in every step, need fewer.
constexpr int rows = 8000, rows_to_peak = 2000;
constexpr double crack = 0.9;  ///< damage of what counts as one

class PeakWatch final : public ExplicitObserver {
 public:
  /// \param sides  driven ends that share the displacement
  PeakWatch(double sides, bool only_to_peak) : sides_(sides), only_to_peak_(only_to_peak) {}

  void on_row(const ExplicitRecord& record, const ExplicitState& /*state*/) override {
    force_ = std::abs(record.load);
    if (!(force_ > peak_force)) return;  // nor where the motion has grown beyond numbers
    peak_force = force_;
    peak_displacement = record.displacement / sides_;
  }
  bool stop_requested() override { return only_to_peak_ && force_ < 0.5 * peak_force; }

  double peak_force = 0.0, peak_displacement = 0.0;

 private:
  double sides_;
  bool only_to_peak_;
  double force_ = 0.0;
};

std::string text_of(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw FileError(path + ": cannot be opened");
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The text of a case without a key; the papers' rules lack some of the consistent ones.
std::string without(const std::string& text, const std::string& key) {
  const std::size_t line = text.find("\n" + key);
  if (line == std::string::npos) return text;
  return std::string(text).erase(line, text.find('\n', line + 1) - line);
}

/// Energies of a run that ended beyond numbers are not shown.
std::string energy_text(double energy) {
  return std::isfinite(energy) ? fmt::format("{:.4f}", energy) : "";
}

std::string row_of(const LatticeTest& test, const LatticeTestRun& run) {
  const ExplicitResult& result = run.result;
  const EnergyBalance& energy = result.last.energy;
  return fmt::format(
      "{},{},{:g},{:g},{},{:.4g},{:.4g},{},{:.1f},{:.4g},{},{},{},{:.1e},{}\n", test.case_name,
      test.variant, test.degrees, *case_of(test).body.spacing, run.particles, result.time_step,
      result.critical_time_step, result.steps, run.peak_force, run.peak_displacement,
      run.cracked.size(), energy_text(energy.fractured), energy_text(energy.external_work),
      result.largest_surplus, result.termination == Termination::failed ? "unstable" : "whole");
}

}  // namespace

CaseFile case_of(const LatticeTest& test) {
  std::vector<TomlValue> keys = {body_key("variant", test.variant),
                                 body_key("rotation", test.degrees)};
  if (test.spacing > 0.0) keys.push_back(body_key("spacing", test.spacing));
  const std::string path = PERILINK_SOURCE_DIR "/meshes/" + test.case_name + ".toml";
  std::string text = text_of(path);
  if (test.variant != "consistent") text = without(text, "crushing_energy");
  CaseFile input = parse_case(text, path, keys);
  for (int axis = 0; axis < 3; ++axis) input.body.offset[axis] += test.offset[axis];
  if (test.change) test.change(input);
  if (test.time_step > 0.0) input.analysis.time_step = test.time_step;
  input.analysis.duration /= test.speed;
  input.analysis.ramp_time /= test.speed;
  input.analysis.rows = test.only_to_peak && !input.supports.empty() ? rows_to_peak : rows;
  return input;
}

LatticeTestRun run_lattice_test(const LatticeTest& test) {
  const CaseFile input = case_of(test);
  const Timer timer;
  const ExplicitCase built = build_explicit_case(input);
  const LatticeRows& lattice = built.model.lattice;
  ExplicitState state(built.model);
  const bool held = !input.supports.empty();
  PeakWatch watch(held ? 1.0 : static_cast<double>(input.displacements.size()), test.only_to_peak);
  LatticeTestRun run;
  run.result = run_explicit_analysis(built.model, state, built.options, watch);
  run.particles = lattice.particles();
  // Held ends tell the force between them without the inertia of what is driven.
  run.peak_force = held ? std::abs(run.result.peak_load) : watch.peak_force;
  run.peak_displacement = held ? run.result.peak_displacement : watch.peak_displacement;
  for (const Index slot : lattice.particle_slot) {
    if (state.damage.empty() || state.damage[slot] <= crack) continue;
    Vector3 x{};
    for (int a = 0; a < lattice.dim; ++a) x[a] = lattice.positions[lattice.at(a, slot)];
    run.cracked.push_back(x);
  }
  run.seconds = timer.seconds();
  return run;
}

std::vector<LatticeTestRun> run_side_by_side(const std::vector<LatticeTest>& tests, int threads) {
  std::vector<LatticeTestRun> runs(tests.size());
  std::atomic<std::size_t> next{0};
  std::mutex printing;
  const auto work = [&] {
    for (std::size_t k = next++; k < tests.size(); k = next++) {
      runs[k] = run_lattice_test(tests[k]);
      const std::lock_guard lock(printing);
      fmt::print("{:6.1f} s  {}", runs[k].seconds, row_of(tests[k], runs[k]));
      std::fflush(stdout);
    }
  };
  std::vector<std::thread> pool;
  for (int t = 1; t < threads; ++t) pool.emplace_back(work);
  work();
  for (std::thread& thread : pool) thread.join();
  return runs;
}

std::string run_lattice_tests(const std::vector<LatticeTest>& tests, int threads) {
  const std::vector<LatticeTestRun> runs = run_side_by_side(tests, threads);
  std::string table =
      "case,rules,degrees,spacing,particles,time_step,critical_time_step,steps,peak_force,"
      "peak_displacement,cracked,fractured,external_work,largest_surplus,ending\n";
  for (std::size_t k = 0; k < tests.size(); ++k) table += row_of(tests[k], runs[k]);
  return table;
}

}  // namespace perilink::verification
