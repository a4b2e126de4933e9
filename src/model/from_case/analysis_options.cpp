#include "model/from_case/analysis_options.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "io/case/sections/case_kinds.hpp"
#include "solver/ranks/process_ranks.hpp"

namespace perilink {
namespace {

StopRules rules_of(const StopSection& section) {
  StopRules stop;
  stop.broken_bonds = section.broken_bonds;
  stop.load_fraction = section.load_fraction;
  stop.displacement = section.displacement;
  return stop;
}

}  // namespace

DamageOptions damage_options(const CaseFile& input, int threads) {
  DamageOptions options;
  options.engine.threads = threads;
  options.engine.route = input.analysis.factor;
  options.engine.solver = input.analysis.solver;
  options.engine.subdomains.edge = input.analysis.coarse_box.value_or(0);
  options.engine.subdomains.ranks = ranks();
  options.engine.event_tolerance = event_tolerance_of(input);
  const bool steps = input.analysis.control == LoadControl::steps;
  if (steps) options.load_factors = input.analysis.load_factors;
  options.stop = rules_of(input.stop);
  std::vector<std::string> sets;  // in the order of LoadedNetwork::sets
  for (const StageSection& stage : input.stages) {
    if (stage.loads == stage.name) sets.push_back(stage.name);
    const auto set = std::find(sets.begin(), sets.end(), stage.loads);
    options.stages.push_back({static_cast<std::size_t>(set - sets.begin()), stage.to,
                              rules_of(stage.stop), stage.to_load});
  }
  return options;
}

ElasticOptions elastic_options(const CaseFile& input, int threads) {
  ElasticOptions options;
  options.threads = threads;
  options.solver = input.analysis.solver;
  options.subdomains.edge = input.analysis.coarse_box.value_or(0);
  options.subdomains.ranks = ranks();
  options.subdomains.tolerance = input.analysis.tolerance.value_or(options.subdomains.tolerance);
  return options;
}

}  // namespace perilink
