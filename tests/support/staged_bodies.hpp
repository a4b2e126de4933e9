#pragma once

#include <vector>

#include "support/analysis_bodies.hpp"

/// \file
/// Bodies with stages of loads.

namespace perilink::test {

/// Returns loads of a body as a load case.
inline LoadCase set_of(const AnalysisBody& body) {
  return {body.loads, body.unknowns, body.reference};
}

inline DamageOptions in_stages(std::vector<StageRules> stages) {
  DamageOptions options;
  options.stages = std::move(stages);
  return options;
}

}  // namespace perilink::test
