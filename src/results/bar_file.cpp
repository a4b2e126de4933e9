#include "results/bar_file.hpp"

#include <fmt/format.h>

#include <iterator>

namespace perilink {

std::string bar_table(const Network& network, const BarState& state) {
  std::string text =
      fmt::format("bar,distance,x,y{},axial_strain,axial_stress,axial_force,slip,bond_stress\n",
                  network.dim() == 3 ? ",z" : "");
  double distance = 0.0;
  for (std::size_t s = 0; s < state.force.size(); ++s) {
    const Index e = network.first_bar_element + static_cast<Index>(s);
    const double length = network.bonds.length(e);
    distance = network.bars.continues(s) ? distance : 0.0;
    const auto first = network.particles.position(network.bonds.first[e]);
    const auto second = network.particles.position(network.bonds.second[e]);
    text += fmt::format("{},{}", network.bars.bar[s] + 1, distance + 0.5 * length);
    for (std::size_t a = 0; a < first.size(); ++a) {
      text += fmt::format(",{}", 0.5 * (first[a] + second[a]));
    }
    text += fmt::format(",{},{},{},{},{}\n", state.strain[s], state.stress[s], state.force[s],
                        state.slip[s], state.bond_stress[s]);
    distance += length;
  }
  return text;
}

}  // namespace perilink
