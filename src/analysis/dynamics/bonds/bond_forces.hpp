#pragma once

#include <memory>

#include "analysis/dynamics/bonds/bond_stencil.hpp"
#include "analysis/dynamics/bonds/explicit_bonds.hpp"
#include "material/strain.hpp"
#include "network/network.hpp"

namespace perilink {

/// Truss bonds of small strains that recur throughout a body are held together
/// (analysis/dynamics/bonds/stencil_bonds.hpp), all others one by one.
/// \param network  has to outlive the result
/// \throws std::invalid_argument for Green strains of bonds that carry moments, and for networks
/// with states (make_explicit_particles)
std::unique_ptr<ExplicitBonds> make_explicit_bonds(const Network& network,
                                                   Strain strain = Strain::small);

/// The stencil of these; without kinds where all bonds are held one by one.
BondStencil stencil_for(const Network& network, Strain strain);

/// make_explicit_bonds() where the stencil is known.
std::unique_ptr<ExplicitBonds> make_explicit_bonds(const Network& network, Strain strain,
                                                   BondStencil stencil);

/// The same with every half of a bond by itself, whatever the body.
std::unique_ptr<ExplicitBonds> make_explicit_halves(const Network& network,
                                                    Strain strain = Strain::small);

}  // namespace perilink
