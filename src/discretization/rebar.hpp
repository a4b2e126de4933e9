#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "base/types.hpp"
#include "discretization/bonds.hpp"
#include "discretization/particles.hpp"

namespace perilink {

/// Reinforcing bar, straight between given points.
struct RebarLine {
  Vector3 from{};
  Vector3 to{};
  std::vector<Vector3> bends = {};  ///< points between the ends, in order
  /// true: embedded points join the nodes to the body; false: the nodes are bonded to solid
  /// particles within the horizon.
  bool embedded = false;
  /// Whether a point is in the body; empty: the whole bar is.
  std::function<bool(const Vector3&)> inside = {};
};

/// Node of an embedded bar.
struct BarNode {
  Index particle = no_index;
  Index bar = no_index;
  Vector3 along{};      ///< unit vector towards the end of the bar; mean at a bend
  double length = 0.0;  ///< length of the bar in the body that is nearest to the node [length]
  bool begins = false;  ///< whether the bar begins at the node
  bool ends = false;
};

/// Particles and bonds that bars add to a body.
struct RebarMesh {
  /// Bar elements between neighbouring nodes, in order along the bars.
  Bonds segments;
  std::vector<Index> bar_of_element;
  std::vector<std::uint8_t> turned;  ///< nonzero: the second end comes first along the bar
  /// Parts of each bar element that the nodes at its two ends, along the bar, tie to the body [-].
  std::vector<std::array<double, 2>> tied_parts;
  /// Bonds between bar nodes and solid particles within the horizon, sorted as Bonds; the second
  /// end is the node. A node that is a solid particle has that particle's bonds and no ties.
  Bonds ties;
  std::vector<BarNode> embedded;  ///< nodes of embedded bars, bar after bar
};

/// Divides each straight piece of a bar into equal elements of about one spacing and appends their
/// nodes to `particles` (kind rebar). Their volume `cell_volume` gives a tie the stiffness of a
/// bond of the concrete. An embedded bar shares no nodes with other bars; a closed one joins its
/// two ends. Other bars are tied to the solid particles within the horizon. Their nodes within 1e-6
/// spacings of a solid particle or of another bar's node are merged with it.
/// \throws std::invalid_argument for a piece of a bar without length
RebarMesh add_rebar(Particles& particles, const std::vector<RebarLine>& bars, double spacing,
                    double horizon, double cell_volume);

}  // namespace perilink
