#include <fmt/format.h>

#include "app/run/damage_run.hpp"
#include "base/error.hpp"
#include "io/case/sections/case_kinds.hpp"
#include "solver/ranks/process_ranks.hpp"

namespace perilink {
namespace {

/// Refuses cases that several MPI processes cannot share. \throws InputError
void refuse_several_processes(const CaseFile& input) {
  if (ranks() == nullptr) return;
  const auto refuse = [&](const char* key, const char* value, const char* allowed) {
    throw InputError(
        input.where(key),
        fmt::format("is \"{}\", which does not run on the {} processes of mpiexec; allowed "
                    "are {}",
                    value, ranks()->count(), allowed),
        "start one process without mpiexec; --threads uses several processors");
  };
  if (input.analysis.type == AnalysisType::relaxation) {
    refuse("analysis.type", "relaxation", "\"elastic\", \"damage\" and \"explicit\"");
  }
  if (has_state_based_particles(input.body)) {
    refuse("body.model", is_lattice(input.body) ? "lattice" : "particles",
           "\"bond_based\" and \"micropolar\"");
  }
}

}  // namespace

std::unique_ptr<RunKind> make_run(const CaseFile& input, int threads, const RunCallbacks& calls) {
  refuse_several_processes(input);
  switch (input.analysis.type) {
    case AnalysisType::elastic: return make_elastic_run(input, threads, calls);
    case AnalysisType::relaxation: return make_relaxation_run(input, threads, calls);
    case AnalysisType::damage: return std::make_unique<DamageRun>(input, threads, calls);
    case AnalysisType::explicit_: break;
  }
  if (input.body.model == BodyModel::lattice) return make_lattice_run(input, threads, calls);
  return make_bond_run(input, threads, calls);
}

}  // namespace perilink
