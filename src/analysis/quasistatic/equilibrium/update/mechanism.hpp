#pragma once

#include "assembly/stiffness.hpp"
#include "network/network.hpp"
#include "network/unknowns.hpp"
#include "solver/factor.hpp"

namespace perilink {

/// Factorises the stiffness of a body and rejects it if a part can move without resistance.
/// Round-off may act as a stiffness there, so that the factor exists. Random forces move every free
/// part, and the bonds then do not store their work.
/// \param network  null: the message names no position
/// \throws NotPositiveDefinite with the position that moves most
void factorize_stiffness(Factor& factor, const SparseMatrix& stiffness, const Unknowns& unknowns,
                         const Network* network, const InternalForceOf& internal_of);

}  // namespace perilink
