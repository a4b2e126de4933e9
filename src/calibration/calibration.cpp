#include "calibration/calibration.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "calibration/balance_measure.hpp"
#include "calibration/balance_search.hpp"
#include "calibration/calibration_cost.hpp"
#include "calibration/facet_shares.hpp"

namespace perilink {
namespace {

/// Numbers of those that are marked.
std::vector<Index> marked(const std::vector<std::uint8_t>& marks) {
  std::vector<Index> numbers;
  for (std::size_t k = 0; k < marks.size(); ++k) {
    if (marks[k] != 0) numbers.push_back(static_cast<Index>(k));
  }
  return numbers;
}

/// Forces of the whole body, and weights of its free bonds, into the report.
/// \param start  stiffnesses before the calibration
void measure_all(const CalibrationInput& input, const Facets& facets, const BondStiffness& start,
                 const BondStiffness& found, double least_weight, CalibrationReport& report) {
  const Index num_particles = input.particles.size();
  const ForceRows rows{input.particles.dim, !start.bending.empty()};
  const std::vector<std::uint8_t> ends = mark_ends(input.bonds, input.free, num_particles);
  report_balance(
      rows, forces_out_of_balance(rows, facets, input.materials, input.bonds, found, num_particles),
      marked(ends), measure_particles(input.bonds, start.axial, num_particles), report);
  report_weights(marked(input.free), found.axial, start.axial, least_weight, report);
}

/// Bonds that lie alike are made alike: a problem whose size hardly depends on that of the body.
/// \param drops_first  whether what must vanish was worth dropping
/// \return what was reached in the whole body, none where it has no exact solution
std::optional<CalibrationReport> calibrate_alike(const CalibrationInput& input,
                                                 const CalibrationOptions& options,
                                                 const Facets& facets, const BondOrbits& orbits,
                                                 BondStiffness& stiffness, bool& drops_first) {
  const OrbitSample sample =
      sample_orbits(orbits, input.particles.size(), input.bonds, input.free, stiffness);
  CalibrationReport report;
  BondStiffness sampled;
  try {
    const CalibrationInput part{input.particles, sample.bonds, input.materials, sample.free,
                                input.box};
    BalanceSearch search(part, options, facets, sample.stiffness, &sample.orbits, true);
    report = search.run(alike_budget(input, orbits, !stiffness.bending.empty()));
    drops_first = search.drops_first();
    sampled = search.result().stiffness;
  } catch (const SolverError&) {  // no factor: rows that depend on others, or no memory
    return std::nullopt;
  }
  report.alike = true;
  BondStiffness found = stiffness;
  if (!spread(sample, sampled, orbits, found)) return std::nullopt;
  measure_all(input, facets, stiffness, found, options.least_weight, report);
  if (std::max(report.residual_after, report.moment_after) > exact_balance) return std::nullopt;
  stiffness = std::move(found);
  return report;
}

/// Every bond by itself.
CalibrationReport calibrate_singly(const CalibrationInput& input, const CalibrationOptions& options,
                                   Facets& facets, BondStiffness& stiffness, bool drops_first) {
  BalanceSearch search(input, options, facets, stiffness, nullptr, drops_first);
  const CalibrationReport report = search.run();
  CalibrationEquations::State found = search.result();
  stiffness = std::move(found.stiffness);
  facets.shares = std::move(found.shares);
  return report;
}

/// Free bonds and all others at their ends: the equations ask for nothing else.
CalibrationReport calibrate_free(const CalibrationInput& input, const CalibrationOptions& options,
                                 Facets& facets, BondStiffness& stiffness, bool drops_first) {
  BondSample sample = sample_bonds(mark_ends(input.bonds, input.free, input.particles.size()),
                                   input.bonds, input.free, stiffness);
  CalibrationInput part{input.particles, sample.bonds, input.materials, std::move(sample.free)};
  part.give_up = input.give_up;
  BondStiffness found = std::move(sample.stiffness);
  const CalibrationReport report = calibrate_singly(part, options, facets, found, drops_first);
  sample.put_back(found, stiffness);
  return report;
}

}  // namespace

CalibrationReport calibrate_bonds(const CalibrationInput& input, const CalibrationOptions& options,
                                  Facets& facets, BondStiffness& stiffness) {
  std::vector<double> lambda;
  for (const LameConstants& material : input.materials) lambda.push_back(material.lambda);
  balance_shares(facets, input.particles.positions,
                 connected_parts(input.bonds, input.particles.size()), lambda);
  if (stiffness.inflection.empty()) stiffness.inflection.assign(stiffness.bending.size(), 0.5);
  bool drops_first = true;
  if (const auto orbits = alike_bonds(input, facets, stiffness)) {
    if (auto report = calibrate_alike(input, options, facets, *orbits, stiffness, drops_first)) {
      return *report;
    }
  }
  if (input.only_alike) return {};
  return meets_few(input) ? calibrate_free(input, options, facets, stiffness, drops_first)
                          : calibrate_singly(input, options, facets, stiffness, drops_first);
}

}  // namespace perilink
