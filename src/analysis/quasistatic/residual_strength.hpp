#pragma once

#include <cstddef>
#include <span>

#include "analysis/quasistatic/damage_options.hpp"

/// \file
/// Peaks of a run by events, and where residual strength begins.

namespace perilink {

/// Number of rows until a crack spans four fifths of the body, along one axis in the plane and two
/// in space; all rows where none does. A crack is a set of bonds that share particles and bear less
/// than half of their largest force. Bonds with a law in compression do not count.
/// \param rows  one for each event
std::size_t rows_before_through_crack(const Network& network, std::span<const StepRecord> rows);

/// Sets the peaks of a run, or of the loads of a stage. Residual strength begins where
/// rows_before_residual() says or where a crack has gone through the body, if the load climbs again
/// by residual_climb or more; with bars, or bonds that crush or are brittle, only where the body
/// gave way.
/// \param rows    one for each event; none: the peaks are known
/// \param result  with the peaks of all rows
void find_peaks(const Network& network, std::span<const StepRecord> rows, DamageResult& result);

}  // namespace perilink
