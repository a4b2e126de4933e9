#pragma once

#include <optional>

#include "network/network.hpp"

namespace perilink {

/// Estimates the number of events until one crack has crossed the body or its weak interfaces: the
/// segments of the bonds across a plane normal to the body's longest side, on average over such
/// planes. Damage beside the crack is not counted.
/// \return nothing for bars, shells and beams, which crack in several places, and without events
std::optional<double> expected_events(const Network& network);

/// Estimates the mean number of events of a batch, fitted to verification/studies/event_tolerance.
/// \param events     expected_events()
/// \param tolerance  EquilibriumOptions::event_tolerance
double expected_batch(double events, double tolerance);

}  // namespace perilink
