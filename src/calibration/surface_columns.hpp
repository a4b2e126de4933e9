#pragma once

#include <vector>

#include "base/types.hpp"
#include "discretization/bonds.hpp"
#include "discretization/facets.hpp"
#include "discretization/particles.hpp"

namespace perilink {

/// Columns of particles under the surface: particles bonded to particles of the surface of the same
/// material belong to the nearest of these, of equally near ones to that in the direction with the
/// least components, the others to themselves. Particles where materials meet belong nowhere.
/// \return head of the column of each particle, no_index: none
std::vector<Index> surface_columns(const Bonds& bonds, const Facets& facets,
                                   const Particles& particles);

}  // namespace perilink
