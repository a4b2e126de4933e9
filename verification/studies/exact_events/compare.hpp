#pragma once

#include <limits>
#include <string>

#include "model/from_case/configure.hpp"

namespace perilink::verification {

/// How far two routes agree event by event.
struct Agreement {
  Index unknowns = 0;
  Index events = 0;                     ///< broken bonds in the in-place run
  Index rows = 0;                       ///< its events, also those after which bonds went on
  std::string termination;              ///< how the in-place run ended
  Index compared = 0;                   ///< events that the other route ran
  Index mismatches = 0;                 ///< other element at the same event
  double load_factor_difference = 0.0;  ///< largest relative one of the events compared
  double energy_error = 0.0;  ///< in the in-place run: |work - stored - dissipated| / work
  double largest_residual = 0.0;
  int factorizations = 0;
  double seconds = 0.0;  ///< what the in-place run took
  double other_seconds = 0.0;
  double seconds_per_event = 0.0;  ///< processor time of the in-place run
};

/// Runs a model in place for `events` events (or to collapse) and by the other route for
/// `other_events`, for so many rows at most.
Agreement compare_routes(const Model& model, FactorRoute other, Index events, Index other_events,
                         std::size_t rows = std::numeric_limits<std::size_t>::max(),
                         std::size_t other_rows = std::numeric_limits<std::size_t>::max());

}  // namespace perilink::verification
