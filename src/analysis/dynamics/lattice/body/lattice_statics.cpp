#include "analysis/dynamics/lattice/body/lattice_statics.hpp"

#include <cstdint>
#include <vector>

#include "analysis/dynamics/fundamental_period.hpp"
#include "network/builder/free_bodies.hpp"
#include "network/unknowns.hpp"

namespace perilink {
namespace {

/// Returns which components are prescribed, shape (particles, dim).
std::vector<std::uint8_t> held_components(const ExplicitModel& model,
                                          const std::vector<Index>& slots) {
  const LatticeRows& lattice = model.lattice;
  std::vector<Index> number(static_cast<std::size_t>(lattice.slots), no_index);
  for (std::size_t i = 0; i < slots.size(); ++i) number[slots[i]] = static_cast<Index>(i);
  std::vector<std::uint8_t> held(slots.size() * lattice.dim, 0);
  for (const auto& row : model.prescribed) {
    for (const PrescribedMotion& motion : row) {
      if (number[motion.slot] == no_index) continue;
      held[static_cast<std::size_t>(number[motion.slot]) * lattice.dim + motion.component] = 1;
    }
  }
  return held;
}

}  // namespace

LatticeNetwork lattice_network(const ExplicitModel& model) {
  std::vector<double> own;
  for (int k = 0; k < model.lattice.own_bonds(); ++k) own.push_back(model.own_modulus(k));
  return lattice_network(model.lattice, own, model.moduli.sum, model.volume);
}

double fundamental_period(const ExplicitModel& model) {
  const LatticeNetwork body = lattice_network(model);
  const Network& network = body.network;
  const std::vector<std::uint8_t> held = held_components(model, body.slots);
  const Unknowns unknowns =
      number_unknowns(network.dim(), held, std::vector<double>(held.size(), 0.0));
  const std::vector<std::vector<double>> free = free_motions(network, unknowns);
  Inertia inertia;
  for (const Index slot : body.slots) {
    inertia.mass.insert(inertia.mass.end(), static_cast<std::size_t>(network.dim()),
                        model.mass[slot]);
  }
  return fundamental_period(network, unknowns, inertia, free);
}

}  // namespace perilink
