#include "model/from_case/lattice_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "analysis/dynamics/lattice/body/lattice_loads.hpp"
#include "analysis/dynamics/lattice/body/lattice_statics.hpp"
#include "base/error.hpp"
#include "io/case/sections/case_unused.hpp"
#include "model/body/lattice_model.hpp"
#include "model/conditions/formula_field.hpp"
#include "model/conditions/loads.hpp"
#include "model/conditions/supports.hpp"
#include "model/gauges.hpp"
#include "solver/ranks/process_ranks.hpp"

namespace perilink {
namespace {

constexpr double most_steps = 2e9;  ///< most time steps; step numbers have 32 bits

/// Applies supports and prescribed displacements. \return the reference displacement [length]
double prescribe_motions(const CaseFile& input, Model& places, ExplicitModel& model) {
  const Prescription prescription = collect_prescriptions(input, places);
  places.unknowns = number_unknowns(model.lattice.dim, prescription.held, prescription.value);
  const std::size_t dim = model.lattice.dim;
  std::vector<PrescribedMotion> motions;
  for (std::size_t slot = 0; slot < prescription.held.size(); ++slot) {
    if (!prescription.held[slot]) continue;
    const double amplitude = prescription.value[slot];
    motions.push_back(
        {model.lattice.particle_slot[slot / dim], static_cast<int>(slot % dim), amplitude});
  }
  prescribe(model, motions);
  return relative_motion(prescription.driven, prescription.kept, model.lattice.dim);
}

/// Applies forces to the particles. \return the reference load [force]; zero: none
double load_particles(const CaseFile& input, ExplicitCase& built) {
  const LatticeRows& lattice = built.model.lattice;
  const AppliedLoads applied = collect_loads(input, built.places, lattice.dim);
  const std::size_t dim = lattice.dim;
  std::vector<AppliedForce> forces;
  for (std::size_t slot = 0; slot < applied.loads.forces.size(); ++slot) {
    if (applied.loads.forces[slot] == 0.0) continue;
    forces.push_back({lattice.particle_slot[slot / dim], static_cast<int>(slot % dim),
                      applied.loads.forces[slot]});
  }
  if (!forces.empty()) apply_forces(built.model, forces);
  built.places.loads = applied.loads;
  built.notes.insert(built.notes.end(), applied.notes.begin(), applied.notes.end());
  return total_load(applied.places);
}

/// Applies prescribed motions and loads, and builds the gauges.
void load_body(const CaseFile& input, const LatticeShape& shape, ExplicitCase& built) {
  built.places = lattice_places(input, shape, built.model, built.model.lattice.particle_slot);
  const double driven = prescribe_motions(input, built.places, built.model);
  const double loaded = load_particles(input, built);
  built.options.driven = driven > 0.0;
  built.options.reference = built.options.driven ? driven : loaded;
  if (!(built.options.reference >= smallest_load)) {
    throw InputError(input.where(input.displacements.empty() ? "loads[1]" : "displacements[1]"),
                     "the case has no load: all formulas are zero on their particles, or "
                     "too small for double precision",
                     "change a formula or its region");
  }
  built.gauges = build_gauges(input, built.places, built.notes);
}

/// Sets the external damping of a material without `fundamental_period`, which is computed here.
void damp_externally(const CaseFile& input, ExplicitCase& built) {
  const LatticeMaterialSection& material = *input.materials.front().lattice;
  if (material.external_damping > 0.0) {
    built.fundamental_period = built.model.material.fundamental_period;
  }
  if (material.external_damping == 0.0 || material.fundamental_period) return;
  try {
    built.fundamental_period = fundamental_period(built.model);
  } catch (const SolverError& error) {
    throw InputError(
        input.where("materials[1].external_damping"),
        fmt::format("needs the fundamental period, which was not found: {}", error.what()),
        "give `fundamental_period`");
  }
  built.model.material.external_damping = material.external_damping;
  built.model.material.fundamental_period = built.fundamental_period;
  built.model.mass_damping = mass_damping_rate(material.external_damping, built.fundamental_period);
}

}  // namespace

void choose_steps(const CaseFile& input, double critical_time_step, ExplicitOptions& options) {
  const AnalysisSection& analysis = input.analysis;
  options.duration = analysis.duration;
  options.ramp = analysis.ramp_time;
  options.time_step = analysis.time_step.value_or(analysis.safety * critical_time_step);
  options.rows = analysis.rows;
  options.ranks = ranks();
  if (options.time_step > critical_time_step) {
    throw InputError(input.where("analysis.time_step"),
                     fmt::format("is {:.6g}, larger than the critical time step {:.6g}",
                                 options.time_step, critical_time_step),
                     "give a smaller one, or delete the key: `safety` then sets the "
                     "fraction of the critical time step");
  }
  options.time_step = std::min(options.time_step, analysis.duration);
  const double steps = std::ceil(analysis.duration / options.time_step);
  if (steps <= most_steps) return;
  throw InputError(input.where("analysis.duration"),
                   fmt::format("needs {:.1e} steps of {:.4g}", steps, options.time_step),
                   fmt::format("at most {:.0e} are possible", most_steps));
}

ExplicitCase build_explicit_case(const CaseFile& input) {
  ExplicitCase built;
  if (const auto note = note_of_unused(input)) built.notes.push_back(*note);
  const LatticeShape shape(input);
  built.model = build_lattice(input, shape, built.notes);
  const LatticeRows& lattice = built.model.lattice;
  load_body(input, shape, built);
  damp_externally(input, built);
  built.critical_time_step = critical_time_step(built.model);
  choose_steps(input, built.critical_time_step, built.options);
  for (const Index slot : lattice.particle_slot) built.bonds += lattice.bond_count[slot];
  built.bonds /= 2;
  return built;
}

}  // namespace perilink
