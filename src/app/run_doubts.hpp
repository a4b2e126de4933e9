#pragma once

#include <string>
#include <vector>

#include "analysis/damage_analysis.hpp"
#include "analysis/explicit_analysis.hpp"

namespace perilink {

/// What makes the numbers of an explicit run doubtful, a sentence each: energy that is missing or
/// too much by more than a hundredth of the work, and a load that the supports do not feel.
/// \param peak_load  largest load of the history [force]
std::vector<std::string> doubts_about(const ExplicitResult& result, double peak_load);

/// The same of a quasistatic run: energies that balance, or forces, to no more than six digits.
std::vector<std::string> doubts_about(const DamageResult& result);

}  // namespace perilink
