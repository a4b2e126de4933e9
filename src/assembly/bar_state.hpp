#pragma once

#include <span>
#include <vector>

#include "network/network.hpp"
#include "network/secants.hpp"

namespace perilink {

/// Strains, forces and slips of reinforcing bars.
struct BarState {
  std::vector<double> strain;  ///< per bar element [-]
  std::vector<double> force;   ///< along the bar element, tension positive [force]
  std::vector<double> stress;  ///< force over area [force/length^2]
  /// Displacement of a bar element relative to the solid, towards the end of its bar, mean of its
  /// two ends [length]. The solid at a node moves with the node's embedded point. Without one it
  /// moves by a linear field fitted to the bonded particles, weighted with the intact stiffness of
  /// the slip springs. A node that is a particle of the solid does not slip.
  std::vector<double> slip;
  /// Bond stress that a bar element transfers to the solid, mean of its two ends [force/length^2].
  /// At a node it is the change of the bar force per length over the perimeter. At an end the slip
  /// spring along the bar gives the force; without an embedded point the force beyond the end is
  /// zero.
  std::vector<double> bond_stress;
};

/// Returns the state of all bar elements.
/// \param motion  all particles, shape (particles, width)
BarState bar_state(const Network& network, Secants secants, std::span<const double> motion);

}  // namespace perilink
