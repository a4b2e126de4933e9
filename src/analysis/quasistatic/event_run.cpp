#include "analysis/quasistatic/event_run.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/quasistatic/residual_strength.hpp"
#include "base/error.hpp"
#include "base/memory.hpp"

namespace perilink {

EventRun::EventRun(const LoadedNetwork& problem, const DamageOptions& options)
    : network_(problem.network),
      problem_(problem),
      options_(options),
      reference_(&problem.reference),
      stop_(&options.stop),
      engine_(make_engine()) {
  DamageResult& result = path_.result;
  result.unknowns = problem.unknowns.count;
  if (problem.embedded) {
    host_release_.emplace(network_, *problem.embedded);
    engine_->set_release_threshold(host_release_->embedded_bonds(),
                                   host_release_->release_threshold());
    result.elements = host_release_->num_whole();
  }
  const LoadWork work = engine_->load_work();
  path_.begin_work(work);
  const double whole = work.forces + work.supports;
  result.initial_stiffness = reference_->driven
                                 ? work.supports / (reference_->value * reference_->value)
                                 : reference_->value * reference_->value / whole;
}

std::unique_ptr<EventEngine> EventRun::make_engine() {
  if (options_.stages.empty()) return make_event_engine(problem_, options_.engine);
  auto engine = std::make_unique<StagedEngine>(problem_, options_.engine);
  staged_ = engine.get();
  const StageRules& first = options_.stages.front();
  const double end = first.to.value_or(first.to_load.value_or(1.0));
  if (engine->open_for(end < 0.0 ? -1.0 : 1.0).mechanism) throw CracksSeparate();
  return engine;
}

EventRun::EventRun(const LoadedNetwork& problem, const DamageOptions& options, DamageState saved)
    : network_(problem.network),
      problem_(problem),
      options_(options),
      reference_(&problem.reference),
      stop_(&options.stop),
      path_(std::move(saved.path)) {
  const std::size_t newest = saved.body.loads.newest;
  const Unknowns* motion = &problem.unknowns;
  if (newest > 0) motion = &problem.sets[newest].unknowns;
  if (problem.embedded) {
    host_release_.emplace(network_, *problem.embedded, path_.whole);
    motion = &host_release_->hold(newest > 0 ? *motion : problem.embedded->free);
  }
  if (options.stages.empty()) {
    engine_ = std::make_unique<SingleEventEngine>(problem, options.engine, &saved.body, motion);
  } else {
    auto engine = std::make_unique<StagedEngine>(problem, options.engine, *motion, saved.body);
    staged_ = engine.get();
    engine_ = std::move(engine);
    if (path_.in_stage) follow_rules();
  }
  if (host_release_) {
    engine_->set_release_threshold(host_release_->embedded_bonds(),
                                   host_release_->release_threshold());
  }
  engine_->load_work();  // the measure of a later separation
  if (path_.load_fraction == stop_->load_fraction) return;
  // The rule was raised: rows below it are counted anew.
  path_.load_fraction = stop_->load_fraction;
  path_.rows_below = path_.rows.empty() && has_fallen(path_, options_.load_factors) ? 1 : 0;
  for (auto row = path_.rows.rbegin(); row != path_.rows.rend(); ++row) {
    if (row->side_change != 0) continue;
    if (row->stage != path_.row.stage || !is_below(*row, path_)) break;
    ++path_.rows_below;
  }
}

DamageState EventRun::save() const {
  DamageState saved{engine_->state(), path_};
  saved.path.result.factor = factor_statistics();
  if (host_release_) saved.path.whole = host_release_->whole();
  return saved;
}

const StepRecord* EventRun::next() {
  if (path_.over || path_.result.termination == Termination::failed) return nullptr;
  try {
    if (!is_checked_ && staged_ == nullptr) check();
    is_checked_ = true;
    const bool has_row = staged_ != nullptr              ? by_stages()
                         : options_.load_factors.empty() ? by_events()
                                                         : by_steps();
    path_.over = path_.over || !has_row;
    return has_row ? &path_.row : nullptr;
  } catch (const std::exception& error) {
    fail(error);
    return nullptr;
  }
}

void EventRun::fail(const std::exception& error) {
  path_.end(Termination::failed, failure_text(error));
  if (!path_.result.stages.empty()) end_stage(path_, network_);
}

DamageResult EventRun::result() const {
  DamageResult result = path_.result;
  result.last = path_.row;
  result.broken_bonds += path_.broken_bonds;
  find_peaks(network_, path_.rows, result);
  result.factor = factor_statistics();
  return result;
}

FactorStatistics EventRun::factor_statistics() const {
  FactorStatistics factor = engine_->factor_statistics();
  factor.factorizations += path_.result.factor.factorizations;
  factor.iterations += path_.result.factor.iterations;
  factor.most_bytes = std::max({factor.bytes, factor.most_bytes, path_.result.factor.most_bytes});
  return factor;
}

StepState EventRun::state() {
  return {network_, engine_->secants(), engine_->displacement(),
          host_release_ ? host_release_->whole() : std::span<const std::uint8_t>()};
}

/// Stages keep all displacements current. Unknowns that a host release replaces later could not
/// complete displacements.
StepState EventRun::unsolved_state() {
  if (staged_ != nullptr || host_release_) return state();
  return {network_, engine_->secants(), engine_->where_elements_fail()};
}

std::vector<double> EventRun::completed(const StepState& earlier) {
  const bool is_current = staged_ != nullptr || host_release_;
  const auto motion = is_current ? earlier.displacement
                                 : engine_->displacement(earlier.displacement, earlier.secants);
  return {motion.begin(), motion.end()};
}

void EventRun::adopt(const Unknowns& unknowns) {
  const Freedom freedom = engine_->change_motion(unknowns);
  path_.energy.add_freedom(freedom);
  path_.following.add_freedom(freedom);
  path_.compliance += freedom.growth;
  check();
}

}  // namespace perilink
