#pragma once

#include "calibration/calibration.hpp"
#include "io/case/case_file.hpp"
#include "model/from_case/analysis_options.hpp"
#include "model/model.hpp"

namespace perilink {

/// Builds the model of a case.
/// \throws InputError where the case does not fit its body: empty regions, unsupported particles,
/// free rigid-body modes, contradictory supports
Model build_model(const CaseFile& input, const CalibrationCalls& calibration = {});

/// Builds the model of a case with uncalibrated bonds, in a small part of the time. Sizes, notes,
/// supports, loads, gauges and refusals equal those of build_model().
Model draft_model(const CaseFile& input);

}  // namespace perilink
