#pragma once

#include <span>
#include <vector>

#include "network/network.hpp"
#include "network/secants.hpp"

namespace perilink {

/// How reinforcing bars are strained, and how far they have slipped in the solid around them.
struct BarState {
  std::vector<double> strain;  ///< per segment [-]
  std::vector<double> force;   ///< along it, tension positive [force]
  std::vector<double> stress;  ///< force over area [force/length^2]
  /// By which the ends of a segment have moved towards the end of their bar beyond what the solid
  /// does there, their mean [length]. The solid at a node moves as the node's anchor, or by the
  /// linear field next to the motions of its tied particles, weighted with the intact stiffness of
  /// the ties; a node that is a particle of the solid does not slip.
  std::vector<double> slip;
  /// What the segment gives to the solid around it, the mean of its ends: at each the change of the
  /// force per length over the perimeter of a round bar; at an end with an anchor what the tie
  /// along the bar bears, else beyond it there is no force [force/length^2].
  std::vector<double> bond_stress;
};

/// \param motion  that of all particles, shape (particles, width)
BarState bar_state(const Network& network, Secants secants, std::span<const double> motion);

}  // namespace perilink
