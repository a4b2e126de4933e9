#include "app/run/make_run.hpp"

#include "app/run/bond_run.hpp"
#include "app/run/damage_run.hpp"
#include "app/run/elastic_run.hpp"
#include "app/run/lattice_run.hpp"
#include "app/run/relaxation_run.hpp"

namespace perilink {

std::unique_ptr<RunKind> make_run(const CaseFile& input, int threads, bool quiet) {
  const std::string& type = input.analysis.type;
  if (type == "elastic") return std::make_unique<ElasticRun>(input, threads, quiet);
  if (type == "relaxation") return std::make_unique<RelaxationRun>(input, threads, quiet);
  if (type != "explicit") return std::make_unique<DamageRun>(input, threads, quiet);
  if (input.body.model == "lattice") return std::make_unique<LatticeRun>(input, threads);
  return std::make_unique<BondRun>(input, threads, quiet);
}

}  // namespace perilink
