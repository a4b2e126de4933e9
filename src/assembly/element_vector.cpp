#include "assembly/element_vector.hpp"

#include <cmath>

namespace perilink {

SparseVector element_vector(const Network& network, const Unknowns& unknowns, Index element,
                            double stiffness) {
  SparseVector x;
  const double root = std::sqrt(stiffness);
  const std::span<const double> n = network.bonds.direction(element);
  const Index ends[2] = {network.bonds.first[element], network.bonds.second[element]};
  for (int end = 0; end < 2; ++end) {
    for (int a = 0; a < network.dim(); ++a) {
      const Index unknown = unknowns.at(ends[end], a);
      if (unknown == no_index || n[a] == 0.0) continue;
      x.rows[x.size] = unknown;
      x.values[x.size++] = (end == 0 ? -root : root) * n[a];
    }
  }
  return x;
}

}  // namespace perilink
