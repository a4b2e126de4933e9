#pragma once

#include <memory>

#include "analysis/dynamics/bonds/bond_stencil.hpp"
#include "analysis/dynamics/bonds/explicit_bonds.hpp"
#include "material/strain.hpp"
#include "network/network.hpp"

namespace perilink {

/// Returns the explicit bonds of a network. Truss bonds of small strains that recur throughout a
/// body share a stencil (analysis/dynamics/bonds/stencil_bonds.hpp). All others are stored one by
/// one.
/// \param network  must outlive the result
/// \throws std::invalid_argument for Green strains of bonds that carry moments, and for networks
///     with states (make_explicit_particles)
std::unique_ptr<ExplicitBonds> make_explicit_bonds(const Network& network,
                                                   Strain strain = Strain::small);

/// Returns the stencil for make_explicit_bonds(); without kinds where all bonds are stored one by
/// one.
BondStencil stencil_for(const Network& network, Strain strain);

/// Returns the explicit bonds of a network for a given stencil.
std::unique_ptr<ExplicitBonds> make_explicit_bonds(const Network& network, Strain strain,
                                                   BondStencil stencil);

/// Returns the explicit bonds of a network with every directed bond stored one by one.
std::unique_ptr<ExplicitBonds> make_explicit_halves(const Network& network,
                                                    Strain strain = Strain::small);

}  // namespace perilink
