#pragma once

#include <optional>

#include "analysis/quasistatic/damage_analysis.hpp"
#include "analysis/quasistatic/elastic_analysis.hpp"
#include "app/model/from_case/configure.hpp"

namespace perilink {

/// What a case's analysis left.
struct ModelRun {
  DamageResult result;                   ///< elastic cases: one row at load factor 1
  std::optional<ElasticResult> elastic;  ///< elastic cases only
};

/// build_model(), while people at a terminal see how the calibration of the bonds comes along.
Model build_model_visibly(const CaseFile& input, bool quiet);

/// Runs the analysis that a case asks for on its model.
/// \throws SolverError when the stiffness matrix is not positive definite
ModelRun run_model(const CaseFile& input, const Model& model, int threads, StepObserver& observer);

}  // namespace perilink
