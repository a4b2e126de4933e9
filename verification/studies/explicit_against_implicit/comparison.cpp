#include "comparison.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/dynamics/fundamental_period.hpp"
#include "base/timer.hpp"
#include "model/from_case/configure.hpp"

namespace perilink::verification {
namespace {

class ImplicitRecorder final : public StepObserver {
 public:
  void on_step(const StepRecord& row, StateSource&) override {
    if (row.element != no_index) broken.push_back(row.element);
    if (std::abs(row.load) <= std::abs(peak.load)) return;
    peak = row;
  }
  StepRecord peak;
  std::vector<Index> broken;
};

class ExplicitRecorder final : public BondRunObserver {
 public:
  void on_row(const ExplicitRecord&, const BondRunState& state) override {
    secants = state.bonds.secants();
  }
  std::vector<double> secants;
};

}  // namespace

Specimen read_specimen(const std::string& name, const std::string& path) {
  CaseFile input = read_case_file(path);
  input.body.critical_stretch = CriticalStretch::lattice;  // both modes alike, as recorded
  Model model = build_model(input);
  return {name,
          std::move(model.network),
          std::move(model.unknowns),
          std::move(model.loads),
          model.reference,
          damage_options(input, 1)};
}

Outcome run_implicit(const Specimen& specimen) {
  ImplicitRecorder recorder;
  const Timer timer;
  const DamageResult result =
      run_damage_analysis({specimen.network, specimen.unknowns, specimen.loads, specimen.reference},
                          specimen.options, recorder);
  Outcome outcome;
  outcome.seconds = timer.seconds();
  outcome.peak_load = std::abs(recorder.peak.load);
  outcome.peak_displacement = std::abs(recorder.peak.displacement);
  outcome.broken.assign(static_cast<std::size_t>(specimen.network.num_elements()), 0);
  for (const Index e : recorder.broken) outcome.broken[e] = 1;
  outcome.dissipated = result.last.dissipated_energy;
  outcome.steps = result.broken_bonds;
  outcome.surplus = result.energy_error;
  return outcome;
}

Outcome run_explicit(const Specimen& specimen, const Outcome& implicit, double stretch,
                     double periods, int threads) {
  const std::vector<Index>& materials = specimen.network.particles.material;
  const std::vector<double> density(*std::max_element(materials.begin(), materials.end()) + 1, 1.0);
  const Inertia inertia = lumped_inertia(specimen.network, density);
  const double period = fundamental_period(specimen.network, specimen.unknowns, inertia);
  Unknowns unknowns = specimen.unknowns;
  ReferenceLoad reference = specimen.reference;
  const double factor = stretch * implicit.peak_displacement / reference.value;
  for (double& value : unknowns.prescribed) value *= factor;
  reference.value *= factor;
  ExplicitOptions options;
  options.ramp = periods * period;
  options.duration = 1.25 * options.ramp;
  options.rows = 1000;
  options.threads = threads;
  ExplicitRecorder recorder;
  const Timer timer;
  const ExplicitResult result =
      run_explicit_bonds({specimen.network, unknowns, specimen.loads, reference}, inertia,
                         {2.0 * 2.0 * std::numbers::pi / period}, options, recorder);
  Outcome outcome;
  outcome.seconds = timer.seconds();
  outcome.peak_load = std::abs(result.peak_load);
  outcome.peak_displacement = std::abs(result.peak_displacement);
  for (const double secant : recorder.secants) outcome.broken.push_back(secant == 0.0);
  outcome.dissipated = result.last.energy.fractured;
  outcome.steps = result.steps;
  outcome.surplus = result.largest_surplus;
  return outcome;
}

double crack_overlap(const Network& network, const Outcome& a, const Outcome& b) {
  const auto cracked = [&](const Outcome& outcome) {
    std::vector<std::uint8_t> particles(static_cast<std::size_t>(network.particles.size()), 0);
    for (Index e = 0; e < network.num_elements(); ++e) {
      if (!outcome.broken[e]) continue;
      particles[network.bonds.first[e]] = particles[network.bonds.second[e]] = 1;
    }
    return particles;
  };
  const std::vector<std::uint8_t> in_a = cracked(a), in_b = cracked(b);
  Index both = 0, either = 0;
  for (std::size_t i = 0; i < in_a.size(); ++i) {
    both += in_a[i] && in_b[i];
    either += in_a[i] || in_b[i];
  }
  return either > 0 ? static_cast<double>(both) / either : 1.0;
}

}  // namespace perilink::verification
