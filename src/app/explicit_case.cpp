#include "app/explicit_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "analysis/lattice_statics.hpp"
#include "app/lattice_model.hpp"
#include "app/supports.hpp"
#include "base/error.hpp"

namespace perilink {
namespace {

constexpr double most_steps = 2e9;  ///< steps have 32-bit numbers

/// Supports and driven displacements. \return the largest driven displacement [length]
double prescribe_motions(const CaseFile& input, const Model& places, ExplicitModel& model) {
  const Prescription prescription = collect_prescriptions(input, places);
  const std::size_t dim = model.lattice.dim;
  std::vector<PrescribedMotion> motions;
  double largest = 0.0;
  for (std::size_t slot = 0; slot < prescription.held.size(); ++slot) {
    if (!prescription.held[slot]) continue;
    const double amplitude = prescription.value[slot];
    motions.push_back(
        {model.lattice.particle_slot[slot / dim], static_cast<int>(slot % dim), amplitude});
    largest = std::max(largest, std::abs(amplitude));
  }
  prescribe(model, motions);
  if (largest > 0.0) return largest;
  throw InputError(input.where("displacements"),
                   "nothing moves the body: all formulas are zero on their particles", "");
}

/// External damping of a material that does not say what the fundamental period is.
void damp_externally(const CaseFile& input, int threads, ExplicitCase& built) {
  const LatticeMaterialSection& material = *input.materials.front().lattice;
  built.fundamental_period = built.model.material.fundamental_period;
  if (material.external_damping == 0.0 || material.fundamental_period) return;
  try {
    built.fundamental_period = fundamental_period(built.model, threads);
  } catch (const SolverError& error) {
    throw InputError(
        input.where("materials[1].external_damping"),
        fmt::format("refers to the fundamental period, which is not found: {}", error.what()),
        "give `fundamental_period`");
  }
  built.model.material.external_damping = material.external_damping;
  built.model.material.fundamental_period = built.fundamental_period;
  built.model.mass_damping = mass_damping_rate(material.external_damping, built.fundamental_period);
}

/// Chooses the step and refuses one that is not stable for certain.
void choose_steps(const CaseFile& input, ExplicitCase& built) {
  const AnalysisSection& analysis = input.analysis;
  built.critical_time_step = critical_time_step(built.model);
  built.time_step = analysis.time_step.value_or(analysis.safety * built.critical_time_step);
  if (built.time_step > built.critical_time_step) {
    throw InputError(input.where("analysis.time_step"),
                     fmt::format("is {:.6g}, larger than the critical time step {:.6g}",
                                 built.time_step, built.critical_time_step),
                     "take less, or leave it out: `safety` takes a part of the critical one");
  }
  const double steps = std::ceil(analysis.duration / built.time_step);
  if (!(steps <= most_steps)) {
    throw InputError(input.where("analysis.duration"),
                     fmt::format("takes {:.1e} steps of {:.4g}", steps, built.time_step),
                     fmt::format("at most {:.0e} are possible", most_steps));
  }
  built.steps = static_cast<Index>(steps);
  built.options.duration = analysis.duration;
  built.options.ramp = analysis.ramp_time;
  built.options.time_step = built.time_step;
  built.options.rows = analysis.rows;
}

}  // namespace

ExplicitCase build_explicit_case(const CaseFile& input, int threads) {
  ExplicitCase built;
  const LatticeShape shape(input);
  built.model = build_lattice(input, shape);
  const LatticeRows& lattice = built.model.lattice;
  const Model places = lattice_places(input, shape, built.model, lattice.particle_slot);
  built.options.reference = prescribe_motions(input, places, built.model);
  damp_externally(input, threads, built);
  choose_steps(input, built);
  for (const Index slot : lattice.particle_slot) built.bonds += lattice.bond_count[slot];
  built.bonds /= 2;
  return built;
}

}  // namespace perilink
