#pragma once

#include "discretization/particles.hpp"
#include "network/unknowns.hpp"
#include "solver/factor.hpp"

namespace perilink {

/// Factorises the stiffness of a body, and refuses it where a part can move without resistance.
/// Round-off may leave a mechanism a stiffness of 1e-16, and a factor: its pivot over the
/// diagonal tells. Whole bodies have more: a strip of one row of cells and n columns, clamped at
/// one end, has about 1 / n^3.
/// \param particles  null: the message tells no place
/// \throws NotPositiveDefinite, with the place
void factorize_stiffness(Factor& factor, const SparseMatrix& stiffness, const Unknowns& unknowns,
                         const Particles* particles);

}  // namespace perilink
