#include "app/run/damage_run.hpp"

namespace perilink {

std::unique_ptr<RunKind> make_run(const CaseFile& input, int threads, bool quiet) {
  switch (input.analysis.type) {
    case AnalysisType::elastic: return make_elastic_run(input, threads, quiet);
    case AnalysisType::relaxation: return make_relaxation_run(input, threads, quiet);
    case AnalysisType::damage: return std::make_unique<DamageRun>(input, threads, quiet);
    case AnalysisType::explicit_: break;
  }
  if (input.body.model == BodyModel::lattice) return make_lattice_run(input, threads);
  return make_bond_run(input, threads, quiet);
}

}  // namespace perilink
