#include "app/run/lattice_run.hpp"

#include "app/model/gauges.hpp"
#include "app/process/signals.hpp"
#include "app/results/lattice_fields.hpp"

namespace perilink {

void LatticeObserver::on_row(const ExplicitRecord& record, const ExplicitState& state) {
  const LatticeRows& lattice = built_.model.lattice;
  std::vector<double> gauges;
  for (const Gauge& gauge : built_.gauges) {
    gauges.push_back(gauge_value(gauge, lattice.dim, [&](Index particle, int axis) {
      return state.displacement[lattice.at(axis, lattice.particle_slot[particle])];
    }));
  }
  add_row(record, gauges);
  if (fields_are_due(record.time)) write_state(record, state);
  show_steps(record, built_.steps, fmt::format("{} cracked particles", record.cracked_particles));
}

void LatticeObserver::write_state(const ExplicitRecord& record, const ExplicitState& state) {
  write_fields(record.step, record.time,
               [&] { return make_lattice_grid(built_.model, state, record); });
}

bool LatticeObserver::stop_requested() { return stop_signal_received(); }

LatticeRun::LatticeRun(const CaseFile& input, int threads)
    : ExplicitRun(input, threads), built_(build_explicit_case(input)) {
  built_.options.threads = threads;
  notes = built_.notes;
  fundamental_period_ = built_.fundamental_period;
  plan_steps(fmt::format("{} particles, {} bonds", built_.model.lattice.particles(), built_.bonds),
             built_.steps, built_.time_step, built_.critical_time_step);
}

void LatticeRun::analyse() {
  ExplicitState state(built_.model);
  result_ = run_explicit_analysis(built_.model, state, built_.options, *observer_);
}

double LatticeRun::particle_steps() const {
  return 1.0 * built_.model.lattice.particles() * result_.steps;
}

std::string LatticeRun::rate() const {
  return rate_text(particle_steps(), seconds.analysis, "particle-steps");
}

std::string LatticeRun::cracks() const {
  return fmt::format("{} cracked particles", result_.last.cracked_particles);
}

void LatticeRun::tell_cracks(Summary& summary) const {
  summary.add("cracked_particles", result_.last.cracked_particles);
}

std::string LatticeRun::tell_flow(Summary& summary) const {
  if (!built_.model.material.yields) return "";
  const double plastic = result_.last.energy.plastic;
  summary.add("yielded_particles", result_.last.yielded_particles);
  summary.add("plastic_energy", plastic);
  return fmt::format(", {:.6g} by {} yielded ones", plastic, result_.last.yielded_particles);
}

void LatticeRun::tell_sizes(Summary& summary) const {
  const LatticeRows& lattice = built_.model.lattice;
  summary.add("particles", lattice.particles());
  summary.add("bonds", built_.bonds);
  summary.line("size", "{} particles, {} bonds", lattice.particles(), built_.bonds);
  summary.add("spacing", lattice.spacing);
  summary.add("particle_steps_per_second",
              seconds.analysis > 0.0 ? particle_steps() / seconds.analysis : 0.0);
}

RunFacts LatticeRun::facts() const {
  const LatticeRows& lattice = built_.model.lattice;
  const double length = longest_side(lattice.dim, lattice.particles(), [&](Index i, int axis) {
    return lattice.positions[lattice.at(axis, lattice.particle_slot[i])];
  });
  return run_facts(input_, length, observer_->peaks().highest().load);
}

}  // namespace perilink
