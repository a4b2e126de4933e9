#pragma once

#include <optional>

#include "network/embedded_motion.hpp"
#include "network/network.hpp"
#include "network/unknowns.hpp"

namespace perilink {

/// Loads at load factor 1.
struct Loads {
  std::vector<double> forces;  ///< shape (particles, width) [force], moments [force length]
};

/// Reference load or displacement that turns load factors into the two axes of the load curve, each
/// work-conjugate to the other.
struct ReferenceLoad {
  bool driven = false;  ///< displacements drive the body (forces may help them)
  double value = 0.0;   ///< load of all loaded places, or relative displacement of driven ones
};

/// Loads and prescribed motions that grow together in a stage, at load factor 1.
struct LoadCase {
  Loads loads;
  /// What moves from the set's first stage on: slots that it drives were free until then, those of
  /// earlier sets stay held.
  Unknowns unknowns;
  ReferenceLoad reference;
};

/// What an analysis solves: a network, how its particles may move, and what loads them.
struct LoadedNetwork {
  Network network;
  Unknowns unknowns;
  Loads loads;
  ReferenceLoad reference;
  /// Where a case has stages: what they load the body by. The members above are those of the first.
  std::vector<LoadCase> sets = {};
  /// Where finite elements carry particles; `unknowns` is the motion that they begin with.
  std::optional<EmbeddedBody> embedded = {};
};

}  // namespace perilink
