#include "analysis/quasistatic/damage_analysis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/quasistatic/event_run.hpp"
#include "base/error.hpp"

namespace perilink {
namespace {

/// Energy imbalance over the work above which a row is noise: the equilibrium is lost [-].
constexpr double lost_row = 1e-2;

}  // namespace

/// Records the residual and, if it was summed over the elements, the stored energy.
void EventRun::take_note_of(const Balance& balance) {
  path_.row.residual = balance.residual;
  path_.stored_by_elements = balance.stored_energy;
  path_.stored_by_permanent = balance.stored_by_permanent;
  path_.result.largest_residual = std::max(path_.result.largest_residual, balance.residual);
  if (!std::isnan(balance.stored_energy)) path_.checked_compliance = path_.compliance;
}

/// Makes a full residual check after events that may harm the accuracy. Every tenth scheduled check
/// is full, the others are cheap.
void EventRun::look_after(const EventOutcome& outcome) {
  if (outcome.pivot < 1e-3 || residual_may_be_large()) {
    check();
  } else if (path_.events % check_interval() == 0) {
    take_note_of(++path_.looks % 10 == 0 ? engine_->check_equilibrium() : engine_->check_cheaply());
  }
}

/// Returns whether the compliance has grown by a tenth since the last full residual check.
/// Round-off grows with the displacements, which are unbounded as a body separates under forces.
/// Prescribed displacements are bounded, and their compliance is negative.
bool EventRun::residual_may_be_large() const {
  return path_.checked_compliance > 0.0 && path_.compliance > 1.1 * path_.checked_compliance;
}

/// Returns whether bonds have shortened beyond small strains.
bool EventRun::is_beyond_small_strains(double load_factor) {
  return staged_ != nullptr
             ? path_.strains.is_beyond(network_, staged_->displacement(), 1.0, engine_->secants())
             : path_.strains.is_beyond(network_, engine_->where_elements_fail(), load_factor,
                                       engine_->secants());
}

/// Adds the prescribed load factor to the reason of a collapse under forces.
void EventRun::note_overload(double load_factor) {
  if (reference_->driven || path_.result.termination != Termination::collapsed) return;
  path_.result.reason = fmt::format("the body cannot carry the load factor {:.6g}: {}", load_factor,
                                    path_.result.reason);
}

/// Ends the run if bonds would leave small strains before the next event.
/// \return whether the run has ended
bool EventRun::leaves_small_strains(const Event& event) {
  const double motion =
      reference_->driven ? event.load_factor : event.load_factor * path_.compliance;
  if (!path_.strains.is_due(motion) || !is_beyond_small_strains(event.load_factor)) return false;
  if (event.at_constant_load && !reference_->driven) {
    end(Termination::collapsed,
        "bonds keep breaking at constant load until small strains no longer hold");
    return true;
  }
  path_.result.beyond_small_strains = true;
  end(Termination::nothing_breaks,
      fmt::format("before the next bond fails, at the load factor {:.4g}, others would be shorter "
                  "than small strains allow: crushed or compressed parts resist any load, and "
                  "further results would be meaningless",
                  event.load_factor));
  return true;
}

/// Returns the number of events between residual checks.
int EventRun::check_interval() const {
  return path_.row.residual <= options_.engine.residual_tolerance
             ? options_.check_interval
             : std::max(1, options_.check_interval / 10);
}

void EventRun::record(double load_factor, const LoadWork& work, const Event& event) {
  StepRecord row = path_.row;
  path_.energy.advance(load_factor, work);
  ++row.step;
  row.broken_bonds = path_.broken_bonds;
  row.yield_events = path_.yield_events;
  row.load_factor = load_factor;
  row.strain_energy = path_.energy.stored();
  row.load = reference_->driven ? load_factor * work.supports / reference_->value + 0.0  // no -0
                                : load_factor * reference_->value;
  row.displacement = reference_->driven ? load_factor * reference_->value
                     : row.load != 0.0  ? 2.0 * row.strain_energy / row.load
                                        : 0.0;
  if (staged_ != nullptr) measure_permanent(work, row);
  row.dissipated_energy = path_.energy.dissipated();
  row.external_work = path_.energy.external_work();
  row.released_energy = path_.energy.released();
  row.elements = path_.result.elements;
  row.constraint_energy = path_.energy.freed();
  row.factorizations = path_.result.factor.factorizations + engine_->factorizations();
  row.element = event.element;
  row.others = event.others;
  const bool fails = event.element != no_index && !event.changes_side;
  row.events = fails ? static_cast<Index>(event.others.size()) + 1 : 0;
  row.seconds = timer_.seconds();
  timer_.restart();
  judge_balance(row);
  path_.row = std::move(row);
  note_peaks();
  const bool below =
      stop_->load_fraction &&
      std::abs(path_.row.load) < *stop_->load_fraction * std::abs(path_.result.peak_load);
  if (path_.row.side_change == 0) path_.rows_below = below ? path_.rows_below + 1 : 0;
}

/// Compares work and energies of a row.
/// \throws SolverError if they are far out of balance
void EventRun::judge_balance(const StepRecord& row) {
  const double by_elements =
      std::exchange(path_.stored_by_elements, std::numeric_limits<double>::quiet_NaN());
  const double stored = std::isnan(by_elements) ? row.strain_energy
                                                : row.load_factor * row.load_factor * by_elements +
                                                      path_.stored_by_permanent.at(row.load_factor);
  const double whole = staged_ != nullptr ? path_.most_work : std::abs(row.external_work);
  if (whole == 0.0) return;
  const double kept = stored + row.dissipated_energy + path_.energy.freed();
  const double error = std::abs(row.external_work - kept) / whole;
  path_.result.energy_error = std::max(path_.result.energy_error, error);
  if (error <= lost_row) return;
  throw SolverError(
      fmt::format("work and energies of row {} are out of balance by {:.2g} of the work: the "
                  "equilibrium is lost, since the body is about to separate",
                  row.step, error));
}

void EventRun::note_peaks() {
  PeakWatch& peaks = path_.result.peaks;
  const bool held = !peaks.gave_way();
  peaks.add({path_.row.displacement, path_.row.load});
  if (held) path_.result.broken_as_gave_way = path_.broken_bonds;
  path_.result.peak_load = peaks.highest().load;
  const bool counts = staged_ == nullptr || path_.row.load != 0.0;
  if (options_.load_factors.empty() && counts) path_.rows.push_back(path_.row);
}

/// Applies an event.
/// \return false if the body separates or forms a mechanism
bool EventRun::pass(const Event& event) {
  const EventOutcome outcome = engine_->apply(event);
  // Under prescribed displacements the sum of the work shows a separation.
  const bool separates = !reference_->driven && staged_ == nullptr &&
                         outcome.compliance_growth > next_to_infinite * path_.compliance;
  if (outcome.mechanism || separates) {
    path_.result.broken_bonds = outcome.broken;  // in addition to those of the last row
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
  path_.broken_bonds += outcome.broken;
  path_.yield_events += outcome.yielded;
  path_.energy.add_event(outcome);
  path_.following.add_event(outcome);
  path_.stored_by_elements = std::numeric_limits<double>::quiet_NaN();  // no longer current
  path_.compliance += outcome.compliance_growth;
  ++path_.events;
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
  if (options_.stop_requested && options_.stop_requested()) {
    end(Termination::interrupted, "a signal stopped the run");
  } else if (stop.broken_bonds && path_.broken_bonds >= *stop.broken_bonds) {
    end(Termination::completed, fmt::format("{} bonds are broken", path_.broken_bonds));
  } else if (stop.load_fraction &&
             path_.rows_below >= (options_.load_factors.empty() ? stop.load_fraction_rows : 1)) {
    end(Termination::completed,
        fmt::format("the load fell below {} of its peak", *stop.load_fraction));
  } else if (stop.displacement && std::abs(path_.row.displacement) >= *stop.displacement) {
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
  path_.over = true;
}

/// Returns the next event below a load factor once hosts that come before it have released. It has
/// no element if there is none, or if a missed release ends the run.
Event EventRun::next_event_below(double most) {
  Event event = engine_->next_event_below(most);
  while (converts(event, 1.0, most)) event = engine_->next_event_below(most);
  return missed_ ? Event{} : event;
}

/// Goes to the next event; the load factor rises or falls to it.
/// \return false at the end of the run
bool EventRun::by_events() {
  if (const auto event = std::exchange(path_.pending, std::nullopt)) {
    if (stop_rule_met() || !pass(*event)) return false;
  }
  LoadWork work;
  Event event;
  do {
    work = engine_->load_work();
    if (work.separated) {
      record_separated(path_.row.load_factor, work);
      return true;
    }
    event = engine_->next_event();
  } while (converts(event));
  if (missed_) return false;
  if (event.element == no_index) {
    end(Termination::nothing_breaks, "no bond can break under this load");
    return false;
  }
  if (leaves_small_strains(event)) return false;
  record(event.load_factor, work, event);
  path_.pending = std::move(event);
  return true;
}

/// Ends a run within a load step with the last equilibrium, at the load factor of the next event.
/// Constant loads do unbounded work on a separating body. The energies therefore belong to a
/// load that followed the events since the last step.
bool EventRun::end_within_step(const Event& event) {
  path_.energy = path_.following;
  record(event.load_factor, engine_->load_work(), event);
  path_.over = true;
  return true;
}

/// Goes to the next prescribed load factor. There elements fail, the worst first, until none
/// exceeds its limit. Within a step, only the number of broken bonds and signals can stop the run.
/// The other stop rules need equilibrium at the end of a step.
/// \return false at the end of the run
bool EventRun::by_steps() {
  if (path_.position > 0 && stop_rule_met()) return false;
  if (path_.position == options_.load_factors.size()) {
    end(Termination::completed, "all load steps are done");
    return false;
  }
  const double load_factor = options_.load_factors[path_.position++];
  Event event = next_event_below(load_factor);
  Index last = no_index;
  path_.following = path_.energy;
  while (event.element != no_index && event.load_factor <= load_factor) {
    path_.energy.advance(load_factor, engine_->load_work());
    path_.following.advance(event.load_factor, engine_->load_work());
    if (stops_within_step()) return end_within_step(event);
    if (!pass(event)) {
      note_overload(load_factor);
      return end_within_step(event);
    }
    last = event.element;
    const LoadWork work = engine_->load_work();
    if (work.separated) {
      record_separated(load_factor, work);
      return true;
    }
    event = next_event_below(load_factor);
  }
  if (missed_) return false;
  // Prescribed loads stay in the result, with a warning.
  path_.result.beyond_small_strains |= is_beyond_small_strains(load_factor);
  record(load_factor, engine_->load_work(), {last});
  return true;
}

bool EventRun::stops_within_step() {
  const bool enough = stop_->broken_bonds && path_.broken_bonds >= *stop_->broken_bonds;
  if (options_.stop_requested && options_.stop_requested()) {
    end(Termination::interrupted, "a signal stopped the run");
  } else if (enough) {
    end(Termination::completed, fmt::format("{} bonds are broken", path_.broken_bonds));
  } else {
    return false;
  }
  return true;
}

void require_held_pieces(const LoadedNetwork& problem, const DamageOptions& options) {
  EventRun(problem, options).require_equilibrium();
}

DamageResult run_damage_analysis(const LoadedNetwork& problem, const DamageOptions& options,
                                 StepObserver& observer) {
  DamageOptions own = options;
  own.stop_requested = [&] { return observer.stop_requested(); };
  EventRun run(problem, own);
  try {
    while (const StepRecord* row = run.next()) observer.on_step(*row, run);
    if (!run.has_failed()) observer.on_end(run.result().last, run);
  } catch (const std::exception& error) {
    run.fail(error);
  }
  return run.result();
}

}  // namespace perilink
