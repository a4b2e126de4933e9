#pragma once

#include <span>
#include <vector>

#include "network/network.hpp"

namespace perilink {

/// Section forces of a beam at its particles. They are means of the sections just left and right,
/// which differ where a force or moment acts.
struct SectionForces {
  std::vector<double> normal;  ///< N, tension positive [force]
  std::vector<double> shear;   ///< V = dM/dx [force]
  std::vector<double> moment;  ///< M, positive if it compresses the upper face (larger y) [force
                               ///< length]
};

/// Returns the sums over the bonds that cross each section (docs/theory/beams.md, Be-3).
/// \param motion  shape (particles, 3)
SectionForces section_forces(const Network& beam, Secants secants, std::span<const double> motion);

}  // namespace perilink
