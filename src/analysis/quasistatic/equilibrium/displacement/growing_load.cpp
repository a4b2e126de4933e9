#include "analysis/quasistatic/equilibrium/displacement/growing_load.hpp"

#include <cmath>
#include <utility>

#include "network/unknowns.hpp"
#include "solver/conjugate_gradients.hpp"

namespace perilink {

GrowingLoad::GrowingLoad(const DamagedBody& body, Update& update, const Loads& loads,
                         std::vector<double> ground_load)
    : body_(body), update_(update), loads_(&loads) {
  field_.ground_load = std::move(ground_load);
}

/// Observers must not change the run, so missing displacements are solved for separately.
/// Displacements of an earlier state are wrong only away from elements that can fail, where the
/// stiffness never changes. The residual of that state therefore gives the correction with any
/// later K^-1.
std::span<const double> GrowingLoad::displacement(std::span<const double> earlier, Secants secants,
                                                  double tolerance) {
  const Unknowns& unknowns = body_.unknowns();
  if (earlier.empty()) {
    if (!stale_) return field_.displacement;
    std::vector<double> all = field_.load(body_, unknowns, *loads_);
    update_.inverse().solve(all, all);
    everywhere_ = unknowns.expand(all);
    return everywhere_;
  }
  std::vector<double> forces = internal_force(body_.network(), secants, earlier).forces;
  for (std::size_t slot = 0; slot < forces.size(); ++slot) {
    forces[slot] = loads_->forces[slot] - forces[slot];
  }
  std::vector<double> residual = unknowns.restrict(forces);
  if (std::sqrt(scalar_product(residual, residual)) <= tolerance * field_.load_norm) return earlier;
  update_.inverse().solve(residual, residual);
  everywhere_ = unknowns.expand(residual);
  for (std::size_t slot = 0; slot < everywhere_.size(); ++slot) {
    everywhere_[slot] += earlier[slot] - unknowns.prescribed[slot];
  }
  return everywhere_;
}

double GrowingLoad::sum_work() const {
  double work = 0.0;
  for (const std::size_t slot : loaded_slots_) {
    work += loads_->forces[slot] * field_.displacement[slot];
  }
  return work;
}

void GrowingLoad::begin() {
  set_loads(*loads_);
  field_.values.assign(body_.num_unknowns(), 0.0);
}

void GrowingLoad::select(bool all) {
  if (all) return part_.select_all();
  const std::vector<std::uint8_t> wanted = part_.select_ends(body_);
  if (!part_.is_all()) update_.inverse().keep_current(wanted);
}

/// A force at a prescribed displacement is a part of the reaction there, whose work counts.
void GrowingLoad::set_loads(const Loads& loads) {
  loads_ = &loads;
  field_.displacement = body_.unknowns().prescribed;
  loaded_slots_.clear();
  for (std::size_t slot = 0; slot < field_.displacement.size(); ++slot) {
    if (body_.unknowns().number[slot] == no_index) continue;
    if (loads.forces[slot] != 0.0) loaded_slots_.push_back(slot);
  }
}

void GrowingLoad::measure_load() {
  field_.measure_load(body_, body_.unknowns(), *loads_);
  // Displacements prescribed on free parts cause no load.
  if (field_.load_norm == 0.0) field_.load_norm = 1.0;
}

void GrowingLoad::refresh() {
  update_.inverse().solve(field_.load(body_, body_.unknowns(), *loads_), field_.values);
  apply();
  stale_ = false;
}

double GrowingLoad::residual_of_part() {
  return part_.residual(body_, *loads_, field_.displacement, internal_) / field_.load_norm;
}

void GrowingLoad::refine(Residual& residual) {
  update_.correct(residual.forces, 2.0 * residual.energy);
  correct(residual.forces);
}

bool GrowingLoad::search() {
  Residual left = residual();
  if (!update_.search(left.forces, field_.values, 2.0 * left.energy, LoadSet::growing)) {
    return false;
  }
  apply();
  return true;
}

void GrowingLoad::correct(std::span<const double> correction) {
  add(1.0, correction);
  apply();
}

void GrowingLoad::set_values(std::vector<double> values) {
  field_.values = std::move(values);
  apply();
}

void GrowingLoad::take_back(std::vector<double> values, double work) {
  set_values(std::move(values));
  stale_ = !part_.is_all() && !update_.lags();
  work_ = work;
}

void GrowingLoad::follow(const Removal& removal) {
  update_.inverse().downdate(removal.vectors(), removal.load_changes(), removal.pivots(),
                             field_.values);
}

void GrowingLoad::add_solution(const SparseVector& forces) {
  update_.inverse().add_solution(forces, field_.values);
}

void GrowingLoad::apply_to_part() {
  part_.move(body_, field_.values, field_.displacement);
  find_largest_motion();
  stale_ = !part_.is_all();
}

/// Moves all particles.
void GrowingLoad::apply() {
  body_.move(field_.values, field_.displacement);
  find_largest_motion();
  work_ = sum_work();
}

void GrowingLoad::find_largest_motion() {
  if (!update_.drift() && !body_.network().carries_moments()) return;
  if (!body_.unknowns().carries())
    field_.largest_motion = largest_displacement(body_.network(), field_.displacement);
}

}  // namespace perilink
