#pragma once

#include "analysis/quasistatic/damage_options.hpp"
#include "network/loaded_network.hpp"

namespace perilink {

/// THE MAIN JOB: loads a network of brittle bonds proportionally, event by event, to collapse.
/// \throws MissedRelease if DamageOptions::begins_again and a host release was missed
DamageResult run_damage_analysis(const LoadedNetwork& problem, const DamageOptions& options,
                                 StepObserver& observer);

/// Opens the damaged bonds that the initial loads pull apart, as a run does before its first row.
/// Costs a factorisation.
/// \throws CracksSeparate if a piece of the body has no other support
void require_held_pieces(const LoadedNetwork& problem, const DamageOptions& options);

}  // namespace perilink
