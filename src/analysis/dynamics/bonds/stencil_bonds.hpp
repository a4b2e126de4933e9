#pragma once

#include <memory>

#include "analysis/dynamics/bonds/bond_stencil.hpp"
#include "analysis/dynamics/bonds/explicit_bonds.hpp"

namespace perilink {

/// Returns truss bonds of small strains on a stencil, computed for whole groups of particles. The
/// only data stored per directed bond is whether it exists.
/// \param network  must outlive the result
/// \param rest     elements off the stencil; null: none
std::unique_ptr<ExplicitBonds> make_stencil_bonds(const Network& network, BondStencil stencil,
                                                  std::unique_ptr<ExplicitBonds> rest);

}  // namespace perilink
