#pragma once

#include <cstddef>
#include <span>

#include "analysis/quasistatic/damage_options.hpp"

/// \file
/// Peaks of a run by events, and the beginning of residual strength.

namespace perilink {

/// Returns the number of rows until a crack spans four fifths of the body, along one axis in the
/// plane and two in space. Returns the number of all rows if no crack does. A crack is a set of
/// bonds that share particles and carry less than half of their largest force. Bonds with a law in
/// compression do not count.
/// \param rows  one per event
std::size_t rows_before_through_crack(const Network& network, std::span<const StepRecord> rows);

/// Sets the peaks of a run, or of the load case of a stage. Residual strength begins at the row of
/// rows_before_residual(). It may begin earlier, where a crack has gone through the body, if the
/// load climbs again by residual_climb. With bars, or bonds that crush or are brittle, it begins
/// only where the body gave way.
/// \param rows    one per event; empty: the peaks are known
/// \param result  holds the peaks of all rows on entry
void find_peaks(const Network& network, std::span<const StepRecord> rows, DamageResult& result);

}  // namespace perilink
