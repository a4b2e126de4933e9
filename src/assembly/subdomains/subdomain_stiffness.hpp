#pragma once

#include <span>
#include <vector>

#include "assembly/lower_triangle.hpp"
#include "assembly/subdomains/subdomain_motions.hpp"

namespace perilink {

/// Coarse stiffness of rigid subdomains, and the diagonal block of each particle.
struct SubdomainStiffness {
  SparseMatrix coarse;         ///< P' K P, lower triangle
  std::vector<double> blocks;  ///< diagonal block of K per particle, one where a component is held;
                               ///< shape (particles, width, width)
  /// Replaces the blocks by their inverses. \return whether all are positive definite
  bool invert_blocks(int width);
};
SubdomainStiffness assemble_subdomain_stiffness(const Network& network, Secants secants,
                                                const Unknowns& unknowns,
                                                const SubdomainMotions& motions);

/// Adds springs between unknowns and the ground.
/// \param springs  stiffness per unknown
void add_springs(SubdomainStiffness& stiffness, const Unknowns& unknowns,
                 const SubdomainMotions& motions, std::span<const double> springs);

}  // namespace perilink
