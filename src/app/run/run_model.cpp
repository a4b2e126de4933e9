#include "app/run/run_model.hpp"

#include <utility>
#include <vector>

#include "app/process/progress.hpp"
#include "base/memory.hpp"

namespace perilink {
namespace {

/// The intact body in its elastic equilibrium.
class ElasticState final : public StateSource {
 public:
  ElasticState(const Network& network, const ElasticResult& result)
      : secants_(static_cast<std::size_t>(network.num_elements()), 1.0),
        state_{network, secants_, result.displacement} {}
  StepState state() override { return state_; }

 private:
  std::vector<double> secants_;
  StepState state_;
};

/// The elastic answer as a history of one row at load factor 1.
DamageResult as_history(const Model& model, const ElasticResult& elastic) {
  DamageResult result;
  result.ending = Ending::completed;
  result.reason = "elastic equilibrium at load factor 1";
  StepRecord& row = result.last;
  row.step = 1;
  row.load_factor = 1.0;
  row.strain_energy = row.external_work = elastic.strain_energy;
  row.load = model.reference.driven ? 2.0 * elastic.strain_energy / model.reference.value
                                    : model.reference.value;
  row.displacement = row.load != 0.0 ? 2.0 * elastic.strain_energy / row.load : 0.0;
  row.residual = result.largest_residual = elastic.residual;
  row.factorizations = 1;
  result.peaks.add({row.displacement, row.load});
  result.peak_load = row.load;
  result.peak_displacement = row.displacement;
  result.initial_stiffness = row.displacement != 0.0 ? row.load / row.displacement : 0.0;
  result.factor = elastic.factor;
  return result;
}

}  // namespace

Model build_model_visibly(const CaseFile& input, bool quiet) {
  CalibrationProgress progress(quiet);
  return build_model(input,
                     [&](int search, double unbalanced) { progress.update(search, unbalanced); });
}

ModelRun run_model(const CaseFile& input, const Model& model, int threads, StepObserver& observer) {
  ModelRun run;
  if (input.analysis.type != AnalysisType::elastic) {
    run.result = run_damage_analysis(model, damage_options(input, threads), observer);
    return run;
  }
  run.elastic = model.elements
                    ? run_elastic_analysis(*model.elements, model.unknowns, model.loads, threads)
                    : run_elastic_analysis(model, threads);
  run.result = as_history(model, *run.elastic);
  ElasticState state(model.network, *run.elastic);
  try {
    observer.on_step(run.result.last, state);
    observer.on_end(run.result.last, state);
  } catch (const std::exception& error) {  // a full disk: the answer is there
    run.result.ending = Ending::failed;
    run.result.reason = failure_text(error);
  }
  return run;
}

}  // namespace perilink
