#pragma once

#include <span>
#include <vector>

#include "base/csr.hpp"
#include "network/network.hpp"

namespace perilink {

/// A connected set of damaged bonds.
struct CrackState {
  Index bonds = 0;
  double mean = 0.0, largest = 0.0;  ///< opening [length]
  Index widest = no_index;           ///< the bond with the largest
};

/// How far a body has opened along the bonds that have lost more than half of their stiffness
/// against a change of length.
struct CrackOpenings {
  std::vector<Index> bonds;        ///< ascending
  std::vector<double> opening;     ///< per such bond [length]
  std::vector<Index> crack;        ///< number of its crack, per such bond
  std::vector<CrackState> cracks;  ///< most bonds first
};

/// The opening of a bond is what its damage adds to the distance of its ends across the crack:
/// (1 - secant) (u_j - u_i) . m, none where that is negative. The normal m of the crack is the axis
/// along which the damaged bonds at both ends lie most, each counted with what it has lost. So a
/// bond that runs obliquely through a crack shows the same opening as one that runs straight.
/// \param families  bonds of each particle (bonds_of_particles)
/// \param motion    shape (particles, width)
CrackOpenings crack_openings(const Network& network, const Csr& neighbourhoods, Secants secants,
                             std::span<const double> motion);

/// The largest opening of the bonds of each particle; shape (particles) [length].
std::vector<double> openings_at_particles(const Network& network, const CrackOpenings& openings);

/// Mean and largest opening of some of the bonds.
/// \param places  in CrackOpenings::bonds
CrackState summed_up(const CrackOpenings& openings, std::span<const std::size_t> places);

}  // namespace perilink
