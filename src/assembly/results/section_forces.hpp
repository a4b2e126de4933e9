#pragma once

#include <span>
#include <vector>

#include "network/network.hpp"

namespace perilink {

/// What the sections of a beam at its particles bear: the mean of those just beside each, which
/// differ where a force or moment acts on it.
struct SectionForces {
  std::vector<double> normal;  ///< N, tension positive [force]
  std::vector<double> shear;   ///< V = dM/dx [force]
  std::vector<double> moment;  ///< M, positive where the upper face, that of larger y, is pressed
                               ///< [force length]
};

/// Sums over the bonds that cross a section (docs/theory/beams.md, Be-3).
/// \param motion  shape (particles, 3)
SectionForces section_forces(const Network& beam, Secants secants, std::span<const double> motion);

}  // namespace perilink
