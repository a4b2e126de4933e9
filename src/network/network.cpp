#include "network/network.hpp"

namespace perilink {

void keep_elements(Network& network, std::span<const std::uint8_t> keep) {
  keep_bonds(network.bonds, keep);
  const auto keep_values = [&](auto& values) {
    std::size_t next = 0;
    for (std::size_t e = 0; e < values.size(); ++e) {
      if (keep[e]) values[next++] = values[e];
    }
    values.resize(next);
  };
  for (std::vector<double>* values : {&network.stiffness, &network.bending, &network.bending_ratio,
                                      &network.inflection, &network.critical_stretch}) {
    keep_values(*values);
  }
  keep_values(network.law_of);
  keep_values(network.hinged);
  keep_values(network.materials_of);
}

}  // namespace perilink
