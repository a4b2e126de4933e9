#pragma once

#include "analysis/dynamics/bonds/runs/dynamic_relaxation.hpp"
#include "model/from_case/configure.hpp"

namespace perilink {

/// Returns the options of a case with type = "relaxation".
RelaxationOptions relaxation_options(const CaseFile& input, int threads);

}  // namespace perilink
