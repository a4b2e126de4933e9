#pragma once

#include <vector>

#include "assembly/lower_triangle.hpp"
#include "assembly/subdomains/subdomain_motions.hpp"

namespace perilink {

/// The stiffness of boxes that move rigidly, and that of each particle alone.
struct SubdomainStiffness {
  SparseMatrix coarse;         ///< P' K P, lower triangle
  std::vector<double> blocks;  ///< K of each particle alone, one where a component is held; shape
                               ///< (particles, width, width)
  /// Puts inverses in place of the blocks. \return whether all are positive definite
  bool invert_blocks(int width);
};
SubdomainStiffness assemble_subdomain_stiffness(const Network& network, Secants secants,
                                                const Unknowns& unknowns,
                                                const SubdomainMotions& motions);

}  // namespace perilink
