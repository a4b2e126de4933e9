#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "discretization/bonds.hpp"
#include "discretization/lattices/lattice.hpp"

namespace perilink {

InteriorNeighbourhood interior_neighbourhood(const Lattice& lattice, double horizon) {
  const double reach = horizon * (1.0 + horizon_tolerance);
  std::array<Index, 3> range{};
  for (int axis = 0; axis < lattice.dim; ++axis) {
    range[axis] = static_cast<Index>(reach / lattice.step[axis]) + 1;
  }
  InteriorNeighbourhood neighbourhood;
  neighbourhood.dim = lattice.dim;
  for (Index k = -range[2]; k <= range[2]; ++k) {
    for (Index j = -range[1]; j <= range[1]; ++j) {
      const double shift = lattice.pattern == Pattern::hexagonal && j % 2 != 0 ? 0.5 : 0.0;
      for (Index i = -range[0]; i <= range[0]; ++i) {
        if (lattice.pattern == Pattern::face_centred && (i + j + k) % 2 != 0) continue;
        const Vector3 offset = {(i + shift) * lattice.step[0], j * lattice.step[1],
                                k * lattice.step[2]};
        const double length = std::hypot(offset[0], offset[1], offset[2]);
        if (length > 0.0 && length <= reach) neighbourhood.offsets.push_back(offset);
      }
    }
  }
  return neighbourhood;
}

double horizon_of_level(Pattern pattern, int level) {
  // Squared radii [spacings^2].
  constexpr std::array<double, 9> rectangular = {0, 1, 2, 4, 5, 8, 9, 10, 13};
  constexpr std::array<double, 9> hexagonal = {0, 1, 3, 4, 7, 9, 12, 13, 16};
  if (pattern != Pattern::rectangular && pattern != Pattern::hexagonal) {
    throw std::invalid_argument(
        "horizon levels exist for the rectangular and the hexagonal pattern only: give the "
        "horizon or its ratio to the spacing");
  }
  if (level < 0 || level > 8) {
    throw std::invalid_argument("horizon level " + std::to_string(level) +
                                ": must be one of 0 to 8");
  }
  return std::sqrt(pattern == Pattern::rectangular ? rectangular[level] : hexagonal[level]);
}

}  // namespace perilink
