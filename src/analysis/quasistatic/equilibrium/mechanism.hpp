#pragma once

#include "assembly/stiffness.hpp"
#include "discretization/particles.hpp"
#include "network/unknowns.hpp"
#include "solver/factor.hpp"

namespace perilink {

/// Factorises the stiffness of a body, and refuses it where a part can move without resistance.
/// Round-off may stand in for a stiffness there and the factor exist; but then the bonds do not
/// hold the work of random forces, under which everything moves that can.
/// \param particles  null: the message tells no place
/// \throws NotPositiveDefinite, with the place that moves most
void factorize_stiffness(Factor& factor, const SparseMatrix& stiffness, const Unknowns& unknowns,
                         const Particles* particles, const InternalForceOf& internal_of);

}  // namespace perilink
