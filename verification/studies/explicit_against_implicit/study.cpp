#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <utility>

#include "comparison.hpp"
#include "problems/program.hpp"
#include "problems/result.hpp"

namespace perilink::verification {
namespace {

/// Farther than where the load has fallen, by hand.
constexpr double stretch = 1.3;

std::string row(const Specimen& specimen, const std::string& mode, double periods,
                const Outcome& outcome, const Outcome& implicit) {
  return fmt::format("{},{},{},{:.4f},{:.4f},{:.3f},{},{:.3f},{},{:.1e},{:.3f}\n", specimen.name,
                     mode, periods, outcome.peak_load, outcome.peak_load / implicit.peak_load,
                     outcome.dissipated, outcome.steps,
                     crack_overlap(specimen.network, outcome, implicit),
                     std::count(outcome.broken.begin(), outcome.broken.end(), 1), outcome.surplus,
                     outcome.seconds);
}

}  // namespace

/// Do explicit runs of the same bonds find the peak load and crack of the implicit mode as they
/// become slower, and what do they cost? Writes result.csv.
bool run_program(const std::vector<std::string>& /*arguments*/) {
  std::string table =
      "specimen,mode,periods,peak_load,peak_over_implicit,dissipated,steps,crack_overlap,"
      "broken_bonds,energy_surplus,seconds\n";
  fmt::print("{}", table);
  const auto add = [&](const std::string& line) {
    fmt::print("{}", line);
    std::fflush(stdout);
    table += line;
  };
  const std::string here = PERILINK_STUDY_DIR;
  const std::pair<std::string, std::string> cases[] = {
      {"block", here + "/block.toml"}, {"beam", here + "/../../../meshes/notched_beam.toml"}};
  for (const auto& [name, path] : cases) {
    const Specimen specimen = read_specimen(name, path);
    const Outcome implicit = run_implicit(specimen);
    add(row(specimen, "implicit", 0.0, implicit, implicit));
    for (const double periods : {5.0, 20.0, 80.0, 320.0}) {
      add(row(specimen, "explicit", periods, run_explicit(specimen, implicit, stretch, periods, 1),
              implicit));
    }
  }
  write_result(PERILINK_STUDY_DIR, table);
  return true;
}

}  // namespace perilink::verification
