#include "analysis/dynamics/lattice/body/lattice_state.hpp"

#include <algorithm>
#include <utility>

namespace perilink {
namespace {

LatticeFlow make_flow(const ExplicitModel& model) {
  LatticeFlow flow;
  if (!model.material.yields) return flow;
  const auto slots = static_cast<std::size_t>(model.lattice.slots);
  const std::size_t own = model.lattice.bonds.size();
  flow.stretch.assign(2 * own * slots, 0.0);
  flow.mean.assign(own * slots, 0.0);
  flow.half.assign(own * slots, 0.0);
  flow.sum.assign(slots, 0.0);
  flow.normal.assign(slots, 0.0);
  flow.locked.assign(model.lattice.rows.size(), 0.0);
  flow.change.assign(model.lattice.rows.size(), 0.0);
  flow.yield.assign(slots, model.material.yielding.yield);
  flow.look_at = flow.yield;
  if (model.rules == LatticeRules::consistent) {
    flow.strain.assign(6 * slots, 0.0);
    flow.equivalent.assign(slots, 0.0);
  }
  flow.crushed.assign(slots, 0);
  return flow;
}

}  // namespace

void StepNumbers::clear_stale(Index row, Index size) {
  if (places.stale[row] == 0) return;
  const auto end = static_cast<std::size_t>(places.first[row] + size);
  for (auto* field : {&stretch, &effective, &owners, &partners, &force}) {
    for (std::size_t at = end; at < field->size(); at += static_cast<std::size_t>(places.slots)) {
      std::fill_n(field->begin() + static_cast<Index>(at), places.stale[row], 0.0);
    }
  }
}

StepNumbers make_step_numbers(const ExplicitModel& model, RowPlaces places) {
  const std::size_t own = model.lattice.bonds.size();
  const auto slots = static_cast<std::size_t>(places.slots);
  StepNumbers numbers;
  numbers.places = std::move(places);
  numbers.effective.assign(own * slots, 0.0);
  numbers.force.assign(own * model.lattice.dim * slots, 0.0);
  numbers.sum.assign(slots, 0.0);
  if (model.alters()) numbers.stretch.assign(own * slots, 0.0);
  if (model.weighs_halves()) {
    for (auto* field : {&numbers.owners, &numbers.partners}) field->assign(own * slots, 0.0);
  }
  return numbers;
}

ExplicitState::ExplicitState(const ExplicitModel& model)
    : now(make_step_numbers(model, lattice_places(model.lattice))) {
  flow = make_flow(model);
  const LatticeRows& lattice = model.lattice;
  const auto slots = static_cast<std::size_t>(lattice.slots);
  const std::size_t own = lattice.bonds.size(), dim = lattice.dim, rows = lattice.rows.size();
  for (auto* array : {&displacement, &velocity, &holding}) array->assign(dim * slots, 0.0);
  rate.assign(own * slots, 0.0);
  damage.assign(slots, 0.0);
  sums.resize(rows);
  reactions.resize(rows);
  fastest.assign(rows, 0.0);
  slack.assign(rows, 0.0);
  path.assign(rows, 0.0);
  bond_changes.assign(rows, 0);
  row_changes.assign(rows, 0);
  near_changes.assign(rows, 0);
  if (!model.alters()) return;
  drag.assign(own * slots, 0.0);
  in_tension = in_compression = lattice.present;
  for (auto* array : {&root_tension, &root_compression}) array->assign(slots, 1.0);
  for (auto* array : {&share_tension, &share_compression}) array->assign(own * slots, 1.0);
  for (auto* array : {&next_damage, &crack_band}) array->assign(slots, 0.0);
  const LatticeMaterial& material = model.material;
  crack_at.assign(slots, never);
  quiet_until.assign(slots, -never);
  if (!material.breakable) return;
  cracked_in.assign(slots, 0);
  for (const Index slot : lattice.particle_slot) {
    const bool whole = lattice.bond_count[slot] == static_cast<Index>(2 * own);
    crack_at[slot] = material.softening.strength / (whole ? 1.0 : material.boundary_factor);
  }
}

}  // namespace perilink
