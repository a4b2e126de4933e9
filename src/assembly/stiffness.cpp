#include "assembly/stiffness.hpp"

#include <algorithm>
#include <vector>

#include "assembly/embedded_stiffness.hpp"
#include "assembly/internal_force.hpp"
#include "assembly/lower_triangle.hpp"
#include "assembly/network_blocks.hpp"

namespace perilink {

SparseMatrix assemble_stiffness(const Network& network, Secants secants, const Unknowns& unknowns) {
  if (unknowns.carries()) return assemble_embedded(network, secants, unknowns);
  return with_blocks(network, secants,
                     [&](const auto& blocks) { return LowerTriangle(blocks, unknowns).build(); });
}

std::vector<double> right_hand_side(const Unknowns& unknowns, const Loads& loads,
                                    const InternalForceOf& internal_of) {
  std::vector<double> forces = loads.forces;
  const auto moves = [](double u) { return u != 0.0; };
  if (std::any_of(unknowns.prescribed.begin(), unknowns.prescribed.end(), moves)) {
    const std::vector<double> driven = internal_of(unknowns.prescribed).forces;
    for (std::size_t slot = 0; slot < forces.size(); ++slot) forces[slot] -= driven[slot];
  }
  return unknowns.restrict(forces);
}

std::vector<double> assemble_right_hand_side(const Network& network, Secants secants,
                                             const Unknowns& unknowns, const Loads& loads) {
  return right_hand_side(unknowns, loads, [&](std::span<const double> u) {
    return internal_force(network, secants, u);
  });
}

}  // namespace perilink
