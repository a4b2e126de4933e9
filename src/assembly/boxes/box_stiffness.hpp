#pragma once

#include <vector>

#include "assembly/boxes/box_motions.hpp"
#include "assembly/lower_triangle.hpp"

namespace perilink {

/// The stiffness of boxes that move rigidly, and that of each particle alone.
struct BoxStiffness {
  SparseMatrix coarse;         ///< P' K P, lower triangle
  std::vector<double> blocks;  ///< K of each particle alone, one where a component is held; shape
                               ///< (particles, width, width)
  /// Puts inverses in place of the blocks. \return whether all are positive definite
  bool invert_blocks(int width);
};
BoxStiffness assemble_box_stiffness(const Network& network, Secants secants,
                                    const Unknowns& unknowns, const BoxMotions& motions);

}  // namespace perilink
