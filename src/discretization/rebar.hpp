#pragma once

#include <cstdint>
#include <vector>

#include "base/types.hpp"
#include "discretization/bonds.hpp"
#include "discretization/particles.hpp"

namespace perilink {

/// A reinforcing bar: straight from point to point.
struct RebarLine {
  Vector3 from{};
  Vector3 to{};
  std::vector<Vector3> bends = {};  ///< between the ends, in their order
  /// Nodes are joined to the body by anchors; otherwise they are bonded like particles of the solid
  /// to those within the horizon.
  bool embedded = false;
};

/// A node of an anchored bar.
struct BarNode {
  Index particle = no_index;
  Index bar = no_index;
  Vector3 along{};      ///< unit vector towards the end of the bar; at a bend the mean
  double length = 0.0;  ///< part of the bar that is nearest to it [length]
  bool begins = false;  ///< the bar begins here, or ends
  bool ends = false;
};

/// Particles and bonds that one or more bars add to a body.
struct RebarMesh {
  /// Bonds between neighbouring nodes of a bar (the bar itself), in the order along the bars, and
  /// the bar that each belongs to.
  Bonds segments;
  std::vector<Index> bar_of_element;
  std::vector<std::uint8_t> turned;  ///< nonzero: the second end comes first along the bar
  /// Bonds between nodes of bars and solid particles within the horizon, sorted as in Bonds; the
  /// second end is the node. A node that is a solid particle has that particle's bonds and no ties.
  Bonds ties;
  std::vector<BarNode> embedded;  ///< nodes of anchored bars, bar after bar
};

/// Divides each straight piece of a bar into equal segments of about the spacing and appends their
/// nodes to `particles` (kind rebar, volume `cell_volume`, the one that gives a tie the stiffness
/// of a bond of the concrete). Nodes of anchored bars are their own, but for a bar that ends where
/// it begins. Others are tied to the solid particles within the horizon, and one within 1e-6
/// spacings of a solid particle or of another bar's node is that particle or node.
/// \throws std::invalid_argument for a piece of a bar without length
RebarMesh add_rebar(Particles& particles, const std::vector<RebarLine>& bars, double spacing,
                    double horizon, double cell_volume);

}  // namespace perilink
