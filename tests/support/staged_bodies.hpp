#pragma once

#include <vector>

#include "support/analysis_bodies.hpp"

/// \file
/// Bodies that are loaded in stages.

namespace perilink::test {

/// The loads of a body as a set.
inline LoadCase set_of(const AnalysisBody& body) {
  return {body.loads, body.unknowns, body.reference};
}

inline DamageOptions in_stages(std::vector<StageRules> stages) {
  DamageOptions options;
  options.stages = std::move(stages);
  return options;
}

}  // namespace perilink::test
