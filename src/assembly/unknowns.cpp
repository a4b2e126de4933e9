#include "assembly/unknowns.hpp"

#include <utility>

namespace perilink {

Unknowns number_unknowns(int dim, const std::vector<std::uint8_t>& held,
                         std::vector<double> prescribed) {
  Unknowns unknowns;
  unknowns.dim = dim;
  unknowns.prescribed = std::move(prescribed);
  unknowns.number.resize(held.size());
  for (std::size_t slot = 0; slot < held.size(); ++slot) {
    unknowns.number[slot] = held[slot] ? no_index : unknowns.count++;
  }
  return unknowns;
}

}  // namespace perilink
