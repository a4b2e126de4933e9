#pragma once

#include <cstdint>
#include <vector>

#include "base/types.hpp"
#include "discretization/bonds.hpp"
#include "discretization/particles.hpp"

namespace perilink {

/// A straight reinforcing bar.
struct RebarLine {
  Vector3 from{};
  Vector3 to{};
};

/// Particles and bonds that one or more bars add to a body.
struct RebarMesh {
  /// Bonds between neighbouring nodes of a bar (the bar itself), in the order along the bars, and
  /// the bar that each belongs to.
  Bonds segments;
  std::vector<Index> bar_of_segment;
  std::vector<std::uint8_t> turned;  ///< nonzero: the second end comes first along the bar
  /// Bonds between nodes of bars and solid particles within the horizon, sorted as in Bonds; the
  /// second end is the node. A node that is a solid particle has that particle's bonds and no ties.
  Bonds ties;
};

/// Divides each bar into equal segments of about the spacing, appends their nodes to `particles`
/// (kind rebar, volume `cell_volume`, the volume that gives a tie the stiffness of a bond of the
/// concrete) and ties every node to the solid particles within the horizon. A node within
/// 1e-6 spacings of a solid particle or of another bar's node is that particle or node.
/// \throws std::invalid_argument for a bar without length
RebarMesh add_rebar(Particles& particles, const std::vector<RebarLine>& bars, double spacing,
                    double horizon, double cell_volume);

}  // namespace perilink
