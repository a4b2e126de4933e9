#include "analysis/explicit_state.hpp"

namespace perilink {

ExplicitState::ExplicitState(const ExplicitModel& model) {
  const LatticeRows& lattice = model.lattice;
  const auto slots = static_cast<std::size_t>(lattice.slots);
  const std::size_t own = lattice.bonds.size(), dim = lattice.dim, rows = lattice.rows.size();
  for (auto* array : {&displacement, &velocity}) array->assign(dim * slots, 0.0);
  for (auto* array : {&stretch, &effective, &rate, &drag}) array->assign(own * slots, 0.0);
  for (auto* array : {&direction, &force}) array->assign(own * dim * slots, 0.0);
  in_tension = in_compression = lattice.present;
  for (auto* array : {&sum, &damage, &next_damage, &crack_band}) array->assign(slots, 0.0);
  sums.resize(rows);
  reactions.resize(rows);
  tension_bound.assign(rows, 0.0);
  cracked.assign(rows, 0);
  changed.assign(rows, 0);
  touched.assign(rows, 0);
}

}  // namespace perilink
