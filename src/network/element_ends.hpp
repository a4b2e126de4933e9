#pragma once

#include <cstddef>

#include "network/network.hpp"

namespace perilink {

/// Calls visit(particle, whether at the second end, weight) for what moves the ends of an element:
/// particles, and those around an anchor.
template <class Visit>
void for_each_end(const Network& network, Index element, Visit visit) {
  for (const bool second : {false, true}) {
    const Index end = second ? network.bonds.second[element] : network.bonds.first[element];
    if (!network.is_anchor(end)) {
      visit(end, second, 1.0);
      continue;
    }
    const Index anchor = end - network.first_anchor();
    const auto particles = network.anchors.particles.row(anchor);
    const auto weights = network.anchors.weights_of(anchor);
    for (std::size_t k = 0; k < particles.size(); ++k) visit(particles[k], second, weights[k]);
  }
}

}  // namespace perilink
