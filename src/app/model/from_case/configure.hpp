#pragma once

#include "app/model/from_case/analysis_options.hpp"
#include "app/model/model.hpp"
#include "calibration/calibration.hpp"
#include "io/case/case_file.hpp"

namespace perilink {

/// Builds the model of a case.
/// \param on_search  told how the calibration of the bonds comes along; may be empty
/// \throws InputError where the case makes no sense for its body: empty regions, particles that
/// nothing holds, free rigid-body modes, contradictory supports
Model build_model(const CaseFile& input, const CalibrationObserver& on_search = {});

/// The same with bonds as they are before calibration, in a small part of its time: sizes, notes,
/// supports, loads and gauges are those of the model, refusals too.
Model draft_model(const CaseFile& input);

}  // namespace perilink
