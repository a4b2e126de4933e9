#include "model/conditions/idle_forces.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>

namespace perilink {

void note_idle_forces(const Network& network, const Loads& loads, const Prescription& prescription,
                      std::vector<std::string>& notes) {
  const auto width = static_cast<std::size_t>(network.width());
  const auto dim = static_cast<std::size_t>(network.dim());
  double idle = 0.0, all = 0.0;
  for (std::size_t slot = 0; slot < loads.forces.size(); ++slot) {
    if (slot % width >= dim) continue;  // a moment
    all += std::abs(loads.forces[slot]);
    if (prescription.value[slot] != 0.0) idle += std::abs(loads.forces[slot]);
  }
  if (idle <= 0.5 * all) return;  // a body force may include clamped particles
  notes.push_back(
      fmt::format("forces of {:.4g} in total act on particles with prescribed "
                  "displacements in their direction: the reactions balance these forces, "
                  "which have no other effect",
                  idle));
}

}  // namespace perilink
