#include "analysis/quasistatic/damage_analysis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/quasistatic/event_run.hpp"
#include "analysis/quasistatic/residual_strength.hpp"
#include "base/error.hpp"
#include "base/memory.hpp"

namespace perilink {
namespace {

/// Energy imbalance over the work above which a row is noise: the equilibrium is lost [-].
constexpr double lost_row = 1e-2;

}  // namespace

EventRun::EventRun(const LoadedNetwork& problem, const DamageOptions& options,
                   StepObserver& observer)
    : network_(problem.network),
      reference_(&problem.reference),
      options_(options),
      stop_(&options.stop),
      observer_(observer),
      problem_(problem),
      engine_(make_engine()),
      state_(problem.network, *engine_),
      strains_(problem.network) {
  result_.unknowns = problem.unknowns.count;
  if (problem.embedded) {
    host_release_.emplace(network_, *problem.embedded);
    state_.elements = &*host_release_;
    engine_->set_release_threshold(host_release_->embedded_bonds(),
                                   host_release_->release_threshold());
    result_.elements = host_release_->num_whole();
  }
  const LoadWork work = begin_work();
  const double whole = work.forces + work.supports;
  result_.initial_stiffness = reference_->driven
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

/// \throws SolverError if the loads do no work on the body
LoadWork EventRun::begin_work() {
  const LoadWork work = engine_->load_work();
  const double whole = work.forces + work.supports;
  compliance_ = work.forces - work.supports;
  if (!(whole > 0.0)) throw SolverError("the loads do no work on the body");
  if (!std::isfinite(whole)) throw SolverError("the elastic solution is not finite");
  return work;
}

/// Runs the analysis. If the solver fails, memory runs out or an observer's disk is full, the
/// result holds everything found so far.
DamageResult EventRun::go() {
  try {
    return staged_ != nullptr              ? by_stages()
           : options_.load_factors.empty() ? by_events()
                                           : by_steps();
  } catch (const std::exception& error) {
    end(Termination::failed, failure_text(error));
    if (!result_.stages.empty()) end_stage();
  }
  result_.last = row_;
  result_.broken_bonds = broken_bonds_;
  find_peaks(network_, rows_, result_);
  result_.factor = engine_->factor_statistics();
  return result_;
}

/// Records the residual and, if it was summed over the elements, the stored energy.
void EventRun::take_note_of(const Balance& balance) {
  row_.residual = balance.residual;
  stored_by_elements_ = balance.stored_energy;
  stored_by_permanent_ = balance.stored_by_permanent;
  result_.largest_residual = std::max(result_.largest_residual, balance.residual);
  if (!std::isnan(balance.stored_energy)) checked_compliance_ = compliance_;
}

/// Makes a full residual check after events that may harm the accuracy. Every tenth scheduled check
/// is full, the others are cheap.
void EventRun::look_after(const EventOutcome& outcome) {
  if (outcome.pivot < 1e-3 || residual_may_be_large()) {
    check();
  } else if (events_ % check_interval() == 0) {
    take_note_of(++looks_ % 10 == 0 ? engine_->check_equilibrium() : engine_->check_cheaply());
  }
}

/// Adopts new unknowns if the options supply them.
void EventRun::follow_motion() {
  if (!options_.new_motion) return;
  const Unknowns* unknowns = options_.new_motion(state_);
  if (unknowns == nullptr) return;
  adopt(*unknowns);
}

void EventRun::adopt(const Unknowns& unknowns) {
  const Freedom freedom = engine_->change_motion(unknowns);
  energy_.add_freedom(freedom);
  following_.add_freedom(freedom);
  compliance_ += freedom.growth;
  check();
}

/// Returns whether the compliance has grown by a tenth since the last full residual check.
/// Round-off grows with the displacements, which are unbounded as a body separates under forces.
/// Prescribed displacements are bounded, and their compliance is negative.
bool EventRun::residual_may_be_large() const {
  return checked_compliance_ > 0.0 && compliance_ > 1.1 * checked_compliance_;
}

/// Returns whether bonds have shortened beyond small strains.
bool EventRun::is_beyond_small_strains(double load_factor) {
  return staged_ != nullptr
             ? strains_.is_beyond(staged_->displacement(), 1.0, engine_->secants())
             : strains_.is_beyond(engine_->where_elements_fail(), load_factor, engine_->secants());
}

/// Adds the prescribed load factor to the reason of a collapse under forces.
void EventRun::note_overload(double load_factor) {
  if (reference_->driven || result_.termination != Termination::collapsed) return;
  result_.reason =
      fmt::format("the body cannot carry the load factor {:.6g}: {}", load_factor, result_.reason);
}

/// Ends the run if bonds would leave small strains before the next event.
/// \return whether the run has ended
bool EventRun::leaves_small_strains(const Event& event) {
  const double motion = reference_->driven ? event.load_factor : event.load_factor * compliance_;
  if (!strains_.is_due(motion) || !is_beyond_small_strains(event.load_factor)) return false;
  if (event.at_constant_load && !reference_->driven) {
    end(Termination::collapsed,
        "bonds keep breaking at constant load until small strains no longer hold");
    return true;
  }
  result_.beyond_small_strains = true;
  end(Termination::nothing_breaks,
      fmt::format("before the next bond fails, at the load factor {:.4g}, others would be shorter "
                  "than small strains allow: crushed or compressed parts resist any load, and "
                  "further results would be meaningless",
                  event.load_factor));
  return true;
}

/// Returns the number of events between residual checks.
int EventRun::check_interval() const {
  return meets_tolerance() ? options_.check_interval : std::max(1, options_.check_interval / 10);
}

void EventRun::record(double load_factor, const LoadWork& work, const Event& event) {
  const StepRecord last = row_;
  energy_.advance(load_factor, work);
  ++row_.step;
  row_.broken_bonds = broken_bonds_;
  row_.yield_events = yield_events_;
  row_.load_factor = load_factor;
  row_.strain_energy = energy_.stored();
  row_.load = reference_->driven ? load_factor * work.supports / reference_->value + 0.0  // no -0
                                 : load_factor * reference_->value;
  row_.displacement = reference_->driven ? load_factor * reference_->value
                      : row_.load != 0.0 ? 2.0 * row_.strain_energy / row_.load
                                         : 0.0;
  if (staged_ != nullptr) measure_permanent(work);
  row_.dissipated_energy = energy_.dissipated();
  row_.external_work = energy_.external_work();
  row_.released_energy = energy_.released();
  row_.elements = result_.elements;
  row_.constraint_energy = energy_.freed();
  row_.factorizations = engine_->factorizations();
  row_.element = event.element;
  row_.others = event.others;
  const bool fails = event.element != no_index && !event.changes_side;
  row_.events = fails ? static_cast<Index>(event.others.size()) + 1 : 0;
  row_.seconds = timer_.seconds();
  timer_.restart();

  const double stored =
      std::isnan(stored_by_elements_)
          ? row_.strain_energy
          : load_factor * load_factor * stored_by_elements_ + stored_by_permanent_.at(load_factor);
  stored_by_elements_ = std::numeric_limits<double>::quiet_NaN();
  const double whole = staged_ != nullptr ? most_work_ : std::abs(row_.external_work);
  if (whole != 0.0) {
    const double kept = stored + row_.dissipated_energy + energy_.freed();
    const double error = std::abs(row_.external_work - kept) / whole;
    result_.energy_error = std::max(result_.energy_error, error);
    if (!(error <= lost_row)) {
      row_ = last;
      throw SolverError(
          fmt::format("work and energies of row {} are out of balance by {:.2g} of the work: the "
                      "equilibrium is lost, since the body is about to separate",
                      last.step + 1, error));
    }
  }
  note_peaks();
  const bool below = stop_->load_fraction &&
                     std::abs(row_.load) < *stop_->load_fraction * std::abs(result_.peak_load);
  if (row_.side_change == 0) rows_below_ = below ? rows_below_ + 1 : 0;
  observer_.on_step(row_, state_);
}

void EventRun::note_peaks() {
  PeakWatch& peaks = result_.peaks;
  const bool held = !peaks.gave_way();
  peaks.add({row_.displacement, row_.load});
  if (held) result_.broken_as_gave_way = broken_bonds_;
  result_.peak_load = peaks.highest().load;
  const bool counts = staged_ == nullptr || row_.load != 0.0;
  if (options_.load_factors.empty() && counts) rows_.push_back(row_);
}

/// Applies an event.
/// \return false if the body separates or forms a mechanism
bool EventRun::pass(const Event& event) {
  const EventOutcome outcome = engine_->apply(event);
  // Under prescribed displacements the sum of the work shows a separation.
  const bool separates = !reference_->driven && staged_ == nullptr &&
                         outcome.compliance_growth > next_to_infinite * compliance_;
  if (outcome.mechanism || separates) {
    result_.broken_bonds = outcome.broken;  // in addition to those of the last row
    end(Termination::collapsed,
        event.changes_side
            ? fmt::format("a mechanism: once the closed element {} has opened, a piece of the body "
                          "is free to move or to turn",
                          event.element)
            : fmt::format("the body separated when element {} failed (pivot {:.1e})",
                          outcome.separating != no_index ? outcome.separating : event.element,
                          outcome.pivot));
    return false;
  }
  broken_bonds_ += outcome.broken;
  yield_events_ += outcome.yielded;
  energy_.add_event(outcome);
  following_.add_event(outcome);
  stored_by_elements_ = std::numeric_limits<double>::quiet_NaN();  // no longer current
  compliance_ += outcome.compliance_growth;
  ++events_;
  look_after(outcome);
  if (outcome.exhausted != no_index) {
    // A bar without further limits forms a mechanism with the body.
    end(Termination::collapsed,
        network_.is_segment(outcome.exhausted)
            ? fmt::format("a bar stretched to {:.0f} times its yield strain: a plastic mechanism",
                          BondLaw::most_stretched)
            : "a bar slips through the body: a mechanism");
    return false;
  }
  return true;
}

bool EventRun::stop_rule_met() {
  const StopRules& stop = *stop_;
  if (observer_.stop_requested()) {
    end(Termination::interrupted, "a signal stopped the run");
  } else if (stop.broken_bonds && broken_bonds_ >= *stop.broken_bonds) {
    end(Termination::completed, fmt::format("{} bonds are broken", broken_bonds_));
  } else if (stop.load_fraction &&
             rows_below_ >= (options_.load_factors.empty() ? stop.load_fraction_rows : 1)) {
    end(Termination::completed,
        fmt::format("the load fell below {} of its peak", *stop.load_fraction));
  } else if (stop.displacement && std::abs(row_.displacement) >= *stop.displacement) {
    end(Termination::completed, fmt::format("the displacement reached {}", *stop.displacement));
  } else {
    return false;
  }
  return true;
}

/// Records a last row in which the body no longer resists the prescribed displacements.
void EventRun::record_separated(double load_factor, const LoadWork& work) {
  end(Termination::collapsed, "the body no longer resists the displacements");
  record(load_factor, work, {});
}

/// Runs from event to event; the load factor rises or falls to each event.
DamageResult EventRun::by_events() {
  check();
  while (true) {
    const LoadWork work = engine_->load_work();
    if (work.separated) {
      record_separated(row_.load_factor, work);
      break;
    }
    const Event event = engine_->next_event();
    if (converts(event)) continue;
    if (event.element == no_index) {
      end(Termination::nothing_breaks, "no bond can break under this load");
      break;
    }
    if (leaves_small_strains(event)) break;
    record(event.load_factor, work, event);
    if (stop_rule_met() || !pass(event)) break;
    follow_motion();
  }
  return finish();
}

/// Ends a run within a load step with the last equilibrium, at the load factor of the next event.
/// Constant loads do unbounded work on a separating body. The energies therefore belong to a
/// load that followed the events since the last step.
DamageResult EventRun::end_within_step(const Event& event) {
  energy_ = following_;
  record(event.load_factor, engine_->load_work(), event);
  return finish();
}

/// Runs through prescribed load factors. At each one elements fail, the worst first, until none
/// exceeds its limit. Within a step, only the number of broken bonds and signals can stop the run.
/// The other stop rules need equilibrium at the end of a step.
DamageResult EventRun::by_steps() {
  check();
  for (const double load_factor : options_.load_factors) {
    Event event = engine_->next_event_below(load_factor);
    while (converts(event, 1.0, load_factor)) event = engine_->next_event_below(load_factor);
    Index last = no_index;
    following_ = energy_;
    while (event.element != no_index && event.load_factor <= load_factor) {
      energy_.advance(load_factor, engine_->load_work());
      following_.advance(event.load_factor, engine_->load_work());
      const bool enough = stop_->broken_bonds && broken_bonds_ >= *stop_->broken_bonds;
      if (observer_.stop_requested() || enough) {
        if (enough) {
          end(Termination::completed, fmt::format("{} bonds are broken", broken_bonds_));
        } else {
          end(Termination::interrupted, "a signal stopped the run");
        }
        return end_within_step(event);
      }
      if (!pass(event)) {
        note_overload(load_factor);
        return end_within_step(event);
      }
      last = event.element;
      const LoadWork work = engine_->load_work();
      if (work.separated) {
        record_separated(load_factor, work);
        return finish();
      }
      event = engine_->next_event_below(load_factor);
      while (converts(event, 1.0, load_factor)) event = engine_->next_event_below(load_factor);
    }
    // Prescribed loads stay in the result, with a warning.
    result_.beyond_small_strains |= is_beyond_small_strains(load_factor);
    record(load_factor, engine_->load_work(), {last});
    if (stop_rule_met()) return finish();
    follow_motion();
  }
  end(Termination::completed, "all load steps are done");
  return finish();
}

DamageResult EventRun::finish() {
  observer_.on_end(row_, state_);
  result_.last = row_;
  result_.broken_bonds += broken_bonds_;
  find_peaks(network_, rows_, result_);
  result_.factor = engine_->factor_statistics();
  return result_;
}

void require_held_pieces(const LoadedNetwork& problem, const DamageOptions& options) {
  struct Silent final : StepObserver {
    void on_step(const StepRecord&, StateSource&) override {}
  } silent;
  EventRun(problem, options, silent).require_equilibrium();
}

DamageResult run_damage_analysis(const LoadedNetwork& problem, const DamageOptions& options,
                                 StepObserver& observer) {
  EventRun run(problem, options, observer);
  return run.go();
}

}  // namespace perilink
