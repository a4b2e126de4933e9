#include "analysis/explicit_state.hpp"

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
  flow.visit = flow.yield;
  if (model.rules == LatticeRules::consistent) {
    flow.strain.assign(6 * slots, 0.0);
    flow.equivalent.assign(slots, 0.0);
  }
  flow.crushed.assign(slots, 0);
  return flow;
}

}  // namespace

ExplicitState::ExplicitState(const ExplicitModel& model) : flow(make_flow(model)) {
  const LatticeRows& lattice = model.lattice;
  const auto slots = static_cast<std::size_t>(lattice.slots);
  const std::size_t own = lattice.bonds.size(), dim = lattice.dim, rows = lattice.rows.size();
  for (auto* array : {&displacement, &velocity}) array->assign(dim * slots, 0.0);
  for (auto* array : {&effective, &rate}) array->assign(own * slots, 0.0);
  force.assign(own * dim * slots, 0.0);
  sum.assign(slots, 0.0);
  damage.assign(slots, 0.0);
  sums.resize(rows);
  reactions.resize(rows);
  fastest.assign(rows, 0.0);
  slack.assign(rows, 0.0);
  path.assign(rows, 0.0);
  duty.assign(rows, 0);
  news.assign(rows, 0);
  near_news.assign(rows, 0);
  if (!model.alters()) return;
  for (auto* array : {&stretch, &drag}) array->assign(own * slots, 0.0);
  in_tension = in_compression = lattice.present;
  for (auto* array : {&share_tension, &share_compression}) array->assign(own * slots, 1.0);
  for (auto* array : {&next_damage, &crack_band}) array->assign(slots, 0.0);
  const LatticeMaterial& material = model.material;
  crack_at.assign(slots, never);
  grow_at.assign(slots, never);
  wait.assign(slots, -never);
  if (!material.breakable) return;
  for (const Index slot : lattice.particle_slot) {
    const bool whole = lattice.bond_count[slot] == static_cast<Index>(2 * own);
    crack_at[slot] = material.softening.strength / (whole ? 1.0 : material.boundary_factor);
  }
}

}  // namespace perilink
