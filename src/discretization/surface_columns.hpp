#pragma once

#include <vector>

#include "base/types.hpp"
#include "discretization/bonds.hpp"
#include "discretization/facets.hpp"

namespace perilink {

/// Columns of particles under the surface: particles bonded to particles of facets belong to the nearest of
/// these, the others and those of facets to themselves.
/// \return head of the column of each particle
std::vector<Index> surface_columns(const Bonds& bonds, const Facets& facets, Index num_particles);

}  // namespace perilink
