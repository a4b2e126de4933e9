#pragma once

#include "analysis/dynamics/bonds/runs/dynamic_relaxation.hpp"
#include "app/model/from_case/configure.hpp"

namespace perilink {

/// Options of a case with type = "relaxation".
RelaxationOptions relaxation_options(const CaseFile& input, int threads);

/// About as many iterations as the first load step takes: until the slowest vibration, damped
/// critically, has decayed to the tolerance.
double expected_iterations(const Model& model, const RelaxationOptions& options);

}  // namespace perilink
