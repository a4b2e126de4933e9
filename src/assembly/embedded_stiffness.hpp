#pragma once

#include "assembly/lower_triangle.hpp"
#include "network/network.hpp"
#include "network/secants.hpp"
#include "network/unknowns.hpp"

namespace perilink {

/// Returns the lower triangle of the stiffness T' K T with embedded particles. Elements of
/// particles with the same unknowns are summed in a small dense matrix first. Zeros between
/// unknowns of elements stay in the pattern.
SparseMatrix assemble_embedded(const Network& network, Secants secants, const Unknowns& unknowns);

}  // namespace perilink
