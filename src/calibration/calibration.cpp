#include "calibration/calibration.hpp"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "calibration/balance_search.hpp"
#include "calibration/calibration_cost.hpp"
#include "calibration/calibration_equations.hpp"
#include "calibration/facet_shares.hpp"

namespace perilink {
namespace {

/// Bonds that lie alike are made alike: a problem whose size hardly depends on that of the body.
/// \param drops_first  whether what must vanish was worth dropping
/// \return what was reached in the whole body, none where it has no exact solution
std::optional<CalibrationReport> calibrate_alike(const CalibrationInput& input,
                                                 const CalibrationOptions& options,
                                                 const Facets& facets, const BondOrbits& orbits,
                                                 BondStiffness& stiffness, bool& drops_first) {
  const OrbitSample sample =
      sample_orbits(orbits, input.particles.size(), input.bonds, input.free, stiffness);
  const CalibrationInput sampled{input.particles, sample.bonds, input.materials, sample.free,
                                 input.box};
  BalanceSearch search(sampled, options, facets, sample.stiffness, &sample.orbits, true);
  CalibrationReport report;
  try {
    report = search.run(alike_budget(input, orbits, !stiffness.bending.empty()));
    drops_first = search.drops_first();
  } catch (const SolverError&) {  // no factor: rows that depend on others, or no memory
    return std::nullopt;
  }
  CalibrationEquations whole(input, options.least_weight, facets, stiffness);
  report.alike = true;
  CalibrationEquations::State state = whole.save();
  if (!spread(sample, search.result().stiffness, orbits, state.stiffness)) {
    return std::nullopt;
  }
  whole.restore(state);
  whole.report_balance(report);
  if (std::max(report.residual_after, report.moment_after) > exact_balance) return std::nullopt;
  report.at_least_weight = report.dropped = 0;
  whole.report_weights(report);
  stiffness = std::move(state.stiffness);
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
