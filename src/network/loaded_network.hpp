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

/// Reference load or displacement that scales load factors to the two axes of the load curve. The
/// axes are work-conjugate.
struct ReferenceLoad {
  bool driven = false;  ///< displacement-controlled; forces may act too
  double value = 0.0;   ///< load of all load regions, or relative displacement of
                        ///< displacement-controlled ones
};

/// Loads and prescribed motions of a stage, proportional to one load factor; values at load factor
/// 1.
struct LoadCase {
  Loads loads;
  /// Motion from the load case's first stage on. Slots that the case prescribes were free before;
  /// slots of earlier cases stay held.
  Unknowns unknowns;
  ReferenceLoad reference;
};

/// Input of an analysis: a network, the motion of its particles, and the loads.
struct LoadedNetwork {
  Network network;
  Unknowns unknowns;
  Loads loads;
  ReferenceLoad reference;
  /// Load cases of the stages; the members above belong to the first stage.
  std::vector<LoadCase> sets = {};
  /// Host elements, if any; `unknowns` is then the motion with the initially active hosts.
  std::optional<EmbeddedBody> embedded = {};
};

}  // namespace perilink
