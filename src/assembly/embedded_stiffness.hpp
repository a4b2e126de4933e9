#pragma once

#include "assembly/lower_triangle.hpp"
#include "network/network.hpp"
#include "network/secants.hpp"
#include "network/unknowns.hpp"

namespace perilink {

/// The stiffness T' K T where something carries particles, lower triangle. Particles that the same
/// unknowns move are taken together: their elements add up in a small dense matrix before they
/// reach the sparse one. Zeros between unknowns of elements keep their place.
SparseMatrix assemble_embedded(const Network& network, Secants secants, const Unknowns& unknowns);

}  // namespace perilink
