#pragma once

#include <memory>

#include "analysis/dynamics/bonds/bond_stencil.hpp"
#include "analysis/dynamics/bonds/explicit_bonds.hpp"

namespace perilink {

/// Truss bonds of small strains on a stencil, computed for whole groups of particles at a time;
/// nothing is stored of half a bond but whether it exists.
/// \param network  has to outlive the result
/// \param rest     the elements off the stencil; null: there are none
std::unique_ptr<ExplicitBonds> make_stencil_bonds(const Network& network, BondStencil stencil,
                                                  std::unique_ptr<ExplicitBonds> rest);

}  // namespace perilink
