#pragma once

#include <vector>

#include "network/network.hpp"
#include "network/network_input.hpp"

namespace perilink {

/// Bond that a pre-crack has cut between materials whose cracks close.
struct CutBond {
  Index first, second;
  Vector3 normal;    ///< of the crack where it cuts the bond, from the first end to the second
  double stiffness;  ///< resistance of the intact bond to motion along the normal [force/length]
};

/// What pre-cracks that close have cut.
struct ClosingCracks {
  std::vector<Crack> cracks;  ///< all pre-cracks, oriented as they cut the bonds
  std::vector<CutBond> bonds;
};

/// Returns the cut bonds without the axial and shear stiffness that does not act along the normal.
/// \param cut  bonds of the network, with the normal of the crack
CutBond cut_bond(const Network& network, Index bond, const Vector3& normal);

/// Adds the contact springs of closed pre-cracks, the last elements before slip springs. Each joins
/// a particle to an embedded point on its normal across the crack, at the distance of a layer of
/// particles that cut bonds joined to it. It has the stiffness that these bonds had along the
/// normal; contact springs from both sides share it. Strains along the face count as they do in the
/// stress along the normal. Slip of the faces and rotations of the body meet no resistance
/// (docs/theory/softening.md, section 8).
/// Call it after the particles of bars are known.
void add_contacts(const Body& body, const NetworkInput& input, const ClosingCracks& closing,
                  Network& network);

}  // namespace perilink
