#pragma once

#include "analysis/quasistatic/damage_options.hpp"
#include "network/loaded_network.hpp"

namespace perilink {

/// THE MAIN JOB: proportional loading of a network of brittle bonds to collapse, event by event.
DamageResult run_damage_analysis(const LoadedNetwork& problem, const DamageOptions& options,
                                 StepObserver& observer);

/// Lets damaged bonds open where the loads of the beginning pull them, as a run does before its
/// first row: costs a factorisation.
/// \throws CracksSeparate where nothing else holds a piece of the body
void require_held_pieces(const LoadedNetwork& problem, const DamageOptions& options);

}  // namespace perilink
