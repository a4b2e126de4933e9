#pragma once

#include "assembly/network.hpp"
#include "assembly/unknowns.hpp"
#include "base/sparse_vector.hpp"

namespace perilink {

/// The x of an element's part x x' of the stiffness matrix: sqrt(k) n at its second end and -sqrt(k) n
/// at its first, on the unknowns; so x'u is sqrt(k) times the extension, but for what prescribed
/// displacements add.
/// \param stiffness  k, the stiffness or the part of it that is meant [force/length]
SparseVector element_vector(const Network& network, const Unknowns& unknowns, Index element,
                            double stiffness);

}  // namespace perilink
