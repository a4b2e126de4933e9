#include "app/run/damage_run.hpp"

namespace perilink {

std::unique_ptr<RunKind> make_run(const CaseFile& input, int threads, bool quiet) {
  const std::string& type = input.analysis.type;
  if (type == "elastic") return make_elastic_run(input, threads, quiet);
  if (type == "relaxation") return make_relaxation_run(input, threads, quiet);
  if (type != "explicit") return std::make_unique<DamageRun>(input, threads, quiet);
  if (input.body.model == "lattice") return make_lattice_run(input, threads);
  return make_bond_run(input, threads, quiet);
}

}  // namespace perilink
