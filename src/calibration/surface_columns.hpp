#pragma once

#include <vector>

#include "base/types.hpp"
#include "discretization/bonds.hpp"
#include "discretization/facets.hpp"
#include "discretization/particles.hpp"

namespace perilink {

/// Assigns particles to columns under the surface. A particle bonded to surface particles of its
/// material belongs to the nearest of them; ties are resolved by the direction with the least
/// components. Other particles are their own column. Particles where materials meet have no column.
/// \return head of the column of each particle, no_index: none
std::vector<Index> surface_columns(const Bonds& bonds, const Facets& facets,
                                   const Particles& particles);

}  // namespace perilink
