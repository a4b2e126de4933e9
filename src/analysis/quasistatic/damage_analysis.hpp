#pragma once

#include "analysis/quasistatic/damage_options.hpp"
#include "network/loaded_network.hpp"

namespace perilink {

/// THE MAIN JOB: proportional loading of a network of brittle bonds to collapse, event by event.
DamageResult run_damage_analysis(const LoadedNetwork& problem, const DamageOptions& options,
                                 StepObserver& observer);

}  // namespace perilink
