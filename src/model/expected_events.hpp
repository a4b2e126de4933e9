#pragma once

#include <optional>

#include "network/network.hpp"

namespace perilink {

/// Bonds that one crack breaks.
struct ExpectedCrack {
  double events = 0.0;  ///< number of their segments
  double energy = 0.0;  ///< their fracture energy [force length]

  /// Returns the number of events until the crack is complete. Events in scattered damage do not
  /// count as progress, since they release little energy. Beyond 1.2 times the energy of a crack
  /// another one is expected.
  /// \param released  StepRecord::released_energy
  double events_left(double released) const;
};

/// Estimates one crack through the weak interfaces of a body or, without interfaces, across it: of
/// all planes normal to an axis the one whose bonds have the smallest fracture energy. Planes
/// within the longest bond of an end of the breakable part do not count. Damage beside the crack
/// and further cracks are left out.
/// \return nothing for shells and beams, and without bonds that can break
std::optional<ExpectedCrack> expected_crack(const Network& network);

/// Estimates the mean number of events of a batch, a part of the bonds abreast of a crack front.
/// The factors were fitted to verification/studies/event_tolerance.
/// \param events     ExpectedCrack::events
/// \param tolerance  EquilibriumOptions::event_tolerance
/// \param dim        of the body
double expected_batch(double events, double tolerance, int dim);

}  // namespace perilink
