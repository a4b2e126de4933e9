// Tension of a concrete block by explicit lattices: peak load, energy and its balance for every
// set of rules and three rotations of the lattice. Writes the table of README.md as result.csv.

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "problems/result.hpp"
#include "specimen.hpp"

int main() {
  using namespace perilink;
  using namespace perilink::verification;
  std::string table =
      "rules,degrees,particles,time_step,critical_time_step,steps,peak_load,peak_over_strength,"
      "fractured,external_work,largest_surplus\n";
  fmt::print("{}", table);
  const std::array rules = {std::pair{LatticeRules::mean_2017, "2017"},
                            std::pair{LatticeRules::least_2018, "2018"},
                            std::pair{LatticeRules::consistent, "consistent"}};
  for (const auto& [rule, name] : rules) {
    const double step = rule == LatticeRules::consistent ? 0.0 : printed_time_step;
    for (const double degrees : {0.0, 15.0, 30.0}) {
      const TensionRun run = run_tension(rule, degrees, step, tension_duration);
      const double peak = std::abs(run.result.peak_load);
      const std::string line = fmt::format(
          "{},{},{},{:.4g},{:.4g},{},{:.1f},{:.4f},{:.4f},{:.4f},{:.1e}\n", name, degrees,
          run.particles, run.result.time_step, run.result.critical_time_step, run.result.steps,
          peak, peak / (tension_strength * tension_section), run.result.last.energy.fractured,
          run.result.last.energy.external_work, run.result.largest_surplus);
      fmt::print("{}", line);
      std::fflush(stdout);
      table += line;
    }
  }
  write_result(PERILINK_STUDY_DIR, table);
  return 0;
}
