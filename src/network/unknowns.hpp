#pragma once

#include <cstdint>
#include <vector>

#include "base/types.hpp"
#include "network/network.hpp"

namespace perilink {

/// Which displacements and rotations are unknown and what the others are (the map T of the design:
/// identity rows for free particles, values for supported and driven ones).
struct Unknowns {
  int width = 2;  ///< components of the motion of a particle, Network::width()
  Index count = 0;
  std::vector<Index> number;       ///< shape (particles, width): number of the unknown, or no_index
  std::vector<double> prescribed;  ///< shape (particles, width): displacement [length]
                                   ///< or rotation [-] at load factor 1 where there is no
                                   ///< unknown, else 0

  Index at(Index particle, int component) const {
    return number[static_cast<std::size_t>(particle) * width + component];
  }
};

/// Loads at load factor 1.
struct Loads {
  std::vector<double> forces;  ///< shape (particles, width) [force], moments [force length]
};

/// Fills `number` and `count` in the order of the particles. `held` has shape (particles, width):
/// nonzero where the displacement or rotation is prescribed.
Unknowns number_unknowns(int width, const std::vector<std::uint8_t>& held,
                         std::vector<double> prescribed);

/// Particles that a bond with bending stiffness ends at; the rotations of the others mean nothing
/// and must not be unknown. Empty where no bond carries a moment.
std::vector<std::uint8_t> rotating_particles(const Network& network);

/// Marks the rotations of all particles that nothing turns as held, shape (particles, width).
void hold_idle_rotations(const Network& network, std::vector<std::uint8_t>& held);

}  // namespace perilink
