#pragma once

#include <memory>

#include "analysis/dynamics/bonds/bond_stencil.hpp"
#include "analysis/dynamics/bonds/explicit_bonds.hpp"

namespace perilink {

/// Trusses of small strains on a stencil: whole groups of particles at a time, with nothing kept of
/// a half of a bond but whether it is there.
/// \param network  has to outlive the result
/// \param rest     the elements off the stencil; null: there are none
std::unique_ptr<ExplicitBonds> make_stencil_bonds(const Network& network, BondStencil stencil,
                                                  std::unique_ptr<ExplicitBonds> rest);

}  // namespace perilink
