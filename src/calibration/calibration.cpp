#include "calibration/calibration.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "calibration/balance_measure.hpp"
#include "calibration/bond_sample.hpp"
#include "calibration/calibration_solver.hpp"
#include "calibration/facet_shares.hpp"
#include "calibration/local_environments.hpp"

namespace perilink {
namespace {

/// Returns the numbers of the marked entries.
std::vector<Index> marked(const std::vector<std::uint8_t>& marks) {
  std::vector<Index> numbers;
  for (std::size_t k = 0; k < marks.size(); ++k) {
    if (marks[k] != 0) numbers.push_back(static_cast<Index>(k));
  }
  return numbers;
}

/// Writes the forces of the whole body and the weights of its free bonds to the report.
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

/// Solves the symmetry-reduced problem, whose size is nearly independent of the body's size.
/// \param presolves  whether dropping variables that are fixed at zero reduced the forces
/// \return report of the whole body; std::nullopt without an exact solution
std::optional<CalibrationReport> calibrate_alike(const CalibrationInput& input,
                                                 const CalibrationOptions& options,
                                                 const Facets& facets, const BondOrbits& orbits,
                                                 BondStiffness& stiffness, bool& presolves) {
  const OrbitSample sample =
      sample_orbits(orbits, input.particles.size(), input.bonds, input.free, stiffness);
  CalibrationReport report;
  BondStiffness sampled;
  try {
    const CalibrationInput part{input.particles, sample.bonds, input.materials, sample.free,
                                input.box};
    CalibrationSolver search(part, options, facets, sample.stiffness, &sample.orbits, true);
    report = search.run();
    presolves = search.presolves();
    sampled = search.result().stiffness;
  } catch (const SolverError&) {  // no factor: dependent rows, or no memory
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

/// Solves the unreduced problem.
CalibrationReport calibrate_singly(const CalibrationInput& input, const CalibrationOptions& options,
                                   Facets& facets, BondStiffness& stiffness, bool presolves) {
  CalibrationSolver search(input, options, facets, stiffness, nullptr, presolves);
  const CalibrationReport report = search.run();
  CalibrationEquations::State found = search.result();
  stiffness = std::move(found.stiffness);
  facets.shares = std::move(found.shares);
  return report;
}

/// Whether at least half of all bonds can be left out of the equations. Otherwise the copy of the
/// other bonds would take more memory than it saves.
bool leaves_out_half(const CalibrationInput& input) {
  const std::vector<std::uint8_t> ends = mark_ends(input.bonds, input.free, input.particles.size());
  Index met = 0;
  for (Index b = 0; b < input.bonds.size(); ++b) {
    met += ends[input.bonds.first[b]] || ends[input.bonds.second[b]];
  }
  return met > 0 && met <= input.bonds.size() / 2;
}

/// Solves for the free bonds. The equations need only the bonds at their ends.
CalibrationReport calibrate_free(const CalibrationInput& input, const CalibrationOptions& options,
                                 Facets& facets, BondStiffness& stiffness, bool presolves) {
  BondSample sample = sample_bonds(mark_ends(input.bonds, input.free, input.particles.size()),
                                   input.bonds, input.free, stiffness);
  CalibrationInput part{input.particles, sample.bonds, input.materials, std::move(sample.free)};
  part.give_up = input.give_up;
  BondStiffness found = std::move(sample.stiffness);
  const CalibrationReport report = calibrate_singly(part, options, facets, found, presolves);
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
  bool presolves = true;
  if (const auto orbits = equivalent_bonds(input, facets, stiffness)) {
    if (auto report = calibrate_alike(input, options, facets, *orbits, stiffness, presolves)) {
      return *report;
    }
  }
  if (input.only_alike) return {};
  return !input.all_free() && leaves_out_half(input)
             ? calibrate_free(input, options, facets, stiffness, presolves)
             : calibrate_singly(input, options, facets, stiffness, presolves);
}

}  // namespace perilink
