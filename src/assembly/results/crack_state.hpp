#pragma once

#include <span>
#include <vector>

#include "base/csr.hpp"
#include "network/network.hpp"

namespace perilink {

/// Openings of the bonds that have lost more than half of their axial stiffness.
struct CrackOpenings {
  std::vector<Index> bonds;     ///< ascending
  std::vector<double> opening;  ///< per such bond [length]
};

/// Returns the openings of damaged bonds. An opening is the part of the distance between the ends,
/// across the crack, that the damage adds: (1 - secant) (u_j - u_i) . m, at least zero. The normal
/// m of the crack is the main axis of the damaged bonds at both ends, each weighted with its lost
/// stiffness. So a bond oblique to the crack has the same opening as a straight one.
/// \param neighbourhoods  bonds of each particle (bonds_of_particles)
/// \param motion          shape (particles, width)
CrackOpenings crack_openings(const Network& network, const Csr& neighbourhoods, Secants secants,
                             std::span<const double> motion);

/// Returns the largest opening among the bonds of each particle, shape (particles) [length].
std::vector<double> openings_at_particles(const Network& network, const CrackOpenings& openings);

}  // namespace perilink
