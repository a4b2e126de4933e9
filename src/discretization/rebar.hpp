#pragma once

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
  /// Bonds between neighbouring nodes of a bar (the bar itself), and the bar that each belongs to.
  Bonds segments;
  std::vector<Index> bar_of_segment;
  /// Bonds between nodes of bars and solid particles within the horizon.
  Bonds ties;
};

/// Divides each bar into equal segments of about the spacing, appends their nodes to `particles`
/// (kind rebar, volume `cell_volume`, the volume that gives a tie the stiffness of a bond of the
/// concrete) and ties every node to the solid particles within the horizon. A node that falls on a
/// solid particle is that particle.
RebarMesh add_rebar(Particles& particles, const std::vector<RebarLine>& bars, double spacing,
                    double horizon, double cell_volume);

}  // namespace perilink
