#pragma once

#include <cstdint>
#include <vector>

#include "base/types.hpp"

namespace perilink {

/// Which displacements are unknown and what the others are (the map T of the design: identity rows
/// for free particles, values for supported and driven ones).
struct Unknowns {
  int dim = 2;
  Index count = 0;
  std::vector<Index> number;       ///< shape (particles, dim): number of the unknown, or no_index
  std::vector<double> prescribed;  ///< shape (particles, dim): displacement at load factor 1
                                   ///< [length] where there is no unknown, else 0

  Index at(Index particle, int axis) const {
    return number[static_cast<std::size_t>(particle) * dim + axis];
  }
};

/// Loads at load factor 1.
struct Loads {
  std::vector<double> forces;  ///< shape (particles, dim) [force]
};

/// Fills `number` and `count` in the order of the particles. `held` has shape (particles, dim):
/// nonzero where the displacement is prescribed.
Unknowns number_unknowns(int dim, const std::vector<std::uint8_t>& held,
                         std::vector<double> prescribed);

}  // namespace perilink
