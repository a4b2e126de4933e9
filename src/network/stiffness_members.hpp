#pragma once

namespace perilink {

/// Calls visit(member) for the members that define the stiffness of a network's elements, in a
/// fixed order. Processes exchange elements with it.
/// \param network  a Network, constant or not
template <class AnyNetwork, class Visit>
void for_each_stiffness_member(AnyNetwork& network, Visit visit) {
  visit(network.particles.dim);
  visit(network.torsion);
  visit(network.bonds.dim);
  visit(network.bonds.first);
  visit(network.bonds.second);
  visit(network.bonds.lengths);
  visit(network.bonds.directions);
  visit(network.bonds.kind);
  visit(network.stiffness);
  visit(network.bending);
  visit(network.bending_ratio);
  visit(network.inflection);
  visit(network.hinged);
  visit(network.state_stiffness);
  visit(network.state_of);
  visit(network.support_stiffness);
}

}  // namespace perilink
