#include "analysis/quasistatic/damage_analysis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/quasistatic/event_run.hpp"
#include "base/error.hpp"
#include "base/plain_text.hpp"

namespace perilink {
namespace {

/// Energy imbalance over the work above which a row is noise: the equilibrium is lost [-].
constexpr double lost_row = 1e-2;

/// Returns whether the compliance has grown by a tenth since the last full residual check.
/// Round-off grows with the displacements, which are unbounded as a body separates under forces.
/// Prescribed displacements are bounded, and their compliance is negative.
bool residual_may_be_large(const PathState& path) {
  return path.checked_compliance > 0.0 && path.compliance > 1.1 * path.checked_compliance;
}

/// Returns the number of events between residual checks.
int check_interval(const PathState& path, const DamageOptions& options) {
  return path.row.residual <= options.engine.residual_tolerance
             ? options.check_interval
             : std::max(1, options.check_interval / 10);
}

/// Compares work and energies of a row.
/// \param whole  work to compare with [force length]
/// \throws SolverError if they are far out of balance
void judge_balance(PathState& path, const StepRecord& row, double whole) {
  const double by_elements =
      std::exchange(path.stored_by_elements, std::numeric_limits<double>::quiet_NaN());
  const double stored = std::isnan(by_elements) ? row.strain_energy
                                                : row.load_factor * row.load_factor * by_elements +
                                                      path.stored_by_permanent.at(row.load_factor);
  if (whole == 0.0) return;
  const double kept = stored + row.dissipated_energy + path.energy.freed();
  const double error = std::abs(row.external_work - kept) / whole;
  path.result.energy_error = std::max(path.result.energy_error, error);
  if (error <= lost_row) return;
  throw SolverError(
      fmt::format("work and energies of row {} are out of balance by {:.2g} of the work: the "
                  "equilibrium is lost, since the body is about to separate",
                  row.step, error));
}

/// Adds the last row to the peaks.
void note_peaks(PathState& path, bool keeps_row) {
  PeakWatch& peaks = path.result.peaks;
  const bool held = !peaks.gave_way();
  peaks.add({path.row.displacement, path.row.load});
  if (held) path.result.broken_as_gave_way = path.broken_bonds;
  path.result.peak_load = peaks.highest().load;
  const std::size_t sign = path.row.load < 0.0 ? 1 : 0;
  for (auto* largest : {&path.largest, &path.largest_of_stage}) {
    (*largest)[sign] = std::max((*largest)[sign], std::abs(path.row.load));
  }
  if (keeps_row) path.rows.push_back(path.row);
}

/// Returns whether the load of a growing stage has turned around: it holds back permanent loads
/// that the body no longer carries, and is no peak.
bool holds_back(const PathState& path, const ReferenceLoad& load) {
  return path.row.load * load.value < 0.0 && path.result.peaks.highest().load * load.value > 0.0;
}

bool is_stopped(PathState& path, const DamageOptions& options) {
  if (!options.stop_requested || !options.stop_requested()) return false;
  path.end(Termination::interrupted, "a signal stopped the run");
  return true;
}

bool has_broken_enough(PathState& path, const StopRules& stop) {
  if (!stop.broken_bonds || path.broken_bonds < *stop.broken_bonds) return false;
  path.end(Termination::completed,
           counted(path.broken_bonds, "bond is broken", "bonds are broken"));
  return true;
}

/// Adds the contribution of permanent loads to the axes and the largest energy of a row.
void measure_permanent(PathState& path, const ReferenceLoad& load, const LoadWork& work,
                       StepRecord& row) {
  const double growing = row.load_factor * work.forces + work.constant.growing_forces;
  const double alone = work.forces + work.supports;  // twice its energy at load factor 1
  if (alone > 0.0) {
    row.equivalent_load = std::sqrt(std::max(0.0, 2.0 * row.strain_energy / alone)) *
                          (load.driven ? std::abs(work.supports) / load.value : load.value);
  }
  if (load.driven) {
    row.load += (work.constant.growing_supports - work.constant.forces_on_clamps) / load.value;
  } else {
    row.displacement = growing / load.value;
  }
  path.most_work = std::max(
      {path.most_work, std::abs(row.external_work), row.strain_energy, row.dissipated_energy});
}

}  // namespace

/// Returns whether bonds have shortened beyond small strains.
bool EventRun::is_beyond_small_strains(double load_factor) {
  return staged_ != nullptr
             ? path_.strains.is_beyond(network_, staged_->displacement(), 1.0, engine_->secants())
             : path_.strains.is_beyond(network_, engine_->where_elements_fail(), load_factor,
                                       engine_->secants());
}

/// Ends the run if bonds would leave small strains before the next event.
/// \return whether the run has ended
bool EventRun::leaves_small_strains(const Event& event) {
  const double motion =
      reference_->driven ? event.load_factor : event.load_factor * path_.compliance;
  if (!path_.strains.is_due(motion) || !is_beyond_small_strains(event.load_factor)) return false;
  if (event.at_constant_load && !reference_->driven) {
    path_.end(Termination::collapsed,
              "bonds keep breaking at constant load until small strains no longer hold");
    return true;
  }
  path_.result.beyond_small_strains = true;
  path_.end(
      Termination::nothing_breaks,
      fmt::format("before the next bond fails, at the load factor {:.4g}, others would be shorter "
                  "than small strains allow: crushed or compressed parts resist any load, and "
                  "further results would be meaningless",
                  event.load_factor));
  return true;
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
  if (staged_ != nullptr) measure_permanent(path_, *reference_, work, row);
  row.dissipated_energy = path_.energy.dissipated();
  row.external_work = path_.energy.external_work();
  row.released_energy = path_.energy.released();
  row.elements = path_.result.elements;
  row.constraint_energy = path_.energy.freed();
  row.factorizations =
      path_.result.factor.factorizations + engine_->factor_statistics().factorizations;
  row.element = event.element;
  row.others = event.others;
  const bool fails = event.element != no_index && !event.changes_side;
  row.events = fails ? static_cast<Index>(event.others.size()) + 1 : 0;
  row.seconds = timer_.seconds();
  timer_.restart();
  judge_balance(path_, row, staged_ != nullptr ? path_.most_work : std::abs(row.external_work));
  path_.row = std::move(row);
  const bool counts = staged_ == nullptr || path_.row.load != 0.0;
  const bool grows = staged_ != nullptr && !stage().to && !stage().to_load;
  if (!grows || !holds_back(path_, *reference_)) {
    note_peaks(path_, options_.load_factors.empty() && counts);
  }
  path_.load_fraction = stop_->load_fraction;
  const bool fallen = has_fallen(path_, options_.load_factors);
  if (path_.row.side_change == 0) path_.rows_below = fallen ? path_.rows_below + 1 : 0;
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
    path_.end(
        Termination::collapsed,
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
  // A full residual check follows events that may harm the accuracy. Every tenth scheduled check is
  // full, the others are cheap.
  if (outcome.pivot < 1e-3 || residual_may_be_large(path_)) {
    check();
  } else if (path_.events % check_interval(path_, options_) == 0) {
    path_.note(++path_.looks % 10 == 0 ? engine_->check_equilibrium() : engine_->check_cheaply());
  }
  if (outcome.exhausted != no_index) {
    // A bar without further limits forms a mechanism with the body.
    path_.end(
        Termination::collapsed,
        network_.is_segment(outcome.exhausted)
            ? fmt::format("a bar stretched to {:.0f} times its yield strain: a plastic mechanism",
                          BondLaw::most_stretched)
            : "a bar slips through the body: a mechanism");
    return false;
  }
  return true;
}

bool stop_rule_met(PathState& path, const DamageOptions& options, const StopRules& stop) {
  if (is_stopped(path, options) || has_broken_enough(path, stop)) return true;
  if (stop.load_fraction &&
      path.rows_below >= (options.load_factors.empty() ? stop.load_fraction_rows : 1)) {
    path.end(Termination::completed,
             fmt::format("the load fell below {} of its peak", *stop.load_fraction));
  } else if (stop.displacement && std::abs(path.row.displacement) >= *stop.displacement) {
    path.end(Termination::completed,
             fmt::format("the displacement reached {}", *stop.displacement));
  } else if (const auto reason = options.rule_met ? options.rule_met() : std::nullopt) {
    path.end(Termination::completed, *reason);
  } else {
    return false;
  }
  return true;
}

/// Records a last row in which the body no longer resists the prescribed displacements.
void EventRun::record_separated(double load_factor, const LoadWork& work) {
  path_.end(Termination::collapsed, "the body no longer resists the displacements");
  record(load_factor, work, {});
  path_.over = true;
}

std::optional<double> end_without_event(PathState& path, const Event& event, const LoadWork& work,
                                        const ReferenceLoad& load, const StopRules& stop,
                                        double now) {
  if (!event.no_strain) {
    path.end(Termination::nothing_breaks, path.events > 0
                                              ? "no further bond can break under this load"
                                              : "no bond can break under this load");
    return std::nullopt;
  }
  if (stop.displacement) {
    const double wanted = *stop.displacement;
    const double growing = path.in_stage ? work.forces : work.forces + work.supports;
    const double last = load.driven
                            ? wanted / load.value
                            : (wanted * load.value - work.constant.growing_forces) / growing;
    if (std::isfinite(last) && last > now) {
      path.end(Termination::completed, fmt::format("the displacement reached {}", wanted));
      return last;
    }
  }
  path.end(Termination::collapsed,
           "the body separated: its pieces move without strains, and springs alone resist");
  return std::nullopt;
}

/// Goes to the next event; the load factor rises or falls to it.
/// \return false at the end of the run
bool EventRun::by_events() {
  if (const auto event = std::exchange(path_.pending, std::nullopt)) {
    if (stop_rule_met(path_, options_, *stop_) || !pass(*event)) return false;
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
    const std::optional<double> last =
        end_without_event(path_, event, work, *reference_, *stop_, path_.row.load_factor);
    if (last) record(*last, work, {});
    path_.over = true;
    return last.has_value();
  }
  if (leaves_small_strains(event)) return false;
  record(event.load_factor, work, event);
  path_.pending = std::move(event);
  return true;
}

/// Goes to the next prescribed load factor. There elements fail, the worst first, until none
/// exceeds its limit. Within a step, only the number of broken bonds and signals can stop the run.
/// The other stop rules need equilibrium at the end of a step.
/// \return false at the end of the run
bool EventRun::by_steps() {
  if (path_.position > 0 && stop_rule_met(path_, options_, *stop_)) return false;
  if (path_.position == options_.load_factors.size()) {
    path_.end(Termination::completed, "all load steps are done");
    return false;
  }
  const double load_factor = options_.load_factors[path_.position++];
  // The run ends with the last equilibrium, at the load factor of the next event. Constant loads do
  // unbounded work on a separating body. The energies therefore belong to a load that followed the
  // events since the last step.
  const auto end_within_step = [&](const Event& event) {
    path_.energy = path_.following;
    record(event.load_factor, engine_->load_work(), event);
    path_.over = true;
    return true;
  };
  // Hosts release before their bonds fail. A missed release ends the run.
  const auto next_event = [&] {
    Event event = engine_->next_event_below(load_factor);
    while (converts(event, 1.0, load_factor)) event = engine_->next_event_below(load_factor);
    return missed_ ? Event{} : event;
  };
  Event event = next_event();
  Index last = no_index;
  path_.following = path_.energy;
  while (event.element != no_index && event.load_factor <= load_factor) {
    path_.energy.advance(load_factor, engine_->load_work());
    path_.following.advance(event.load_factor, engine_->load_work());
    if (is_stopped(path_, options_) || has_broken_enough(path_, *stop_))
      return end_within_step(event);
    if (!pass(event)) {
      if (!reference_->driven) path_.note_overload(load_factor);
      return end_within_step(event);
    }
    last = event.element;
    const LoadWork work = engine_->load_work();
    if (work.separated) {
      record_separated(load_factor, work);
      return true;
    }
    event = next_event();
  }
  if (missed_) return false;
  // Prescribed loads stay in the result, with a warning.
  path_.result.beyond_small_strains |= is_beyond_small_strains(load_factor);
  record(load_factor, engine_->load_work(), {last});
  return true;
}

void require_held_pieces(const LoadedNetwork& problem, const DamageOptions& options) {
  EventRun(problem, options).check();
}

DamageResult run_damage_analysis(const LoadedNetwork& problem, const DamageOptions& options,
                                 StepObserver& observer) {
  DamageOptions own = options;
  own.stop_requested = [&] { return observer.stop_requested(); };
  EventRun run(problem, own);
  try {
    while (const StepRecord* row = run.next()) observer.on_step(*row, run);
    const DamageResult result = run.result();
    if (result.termination != Termination::failed) observer.on_end(result.last, run);
  } catch (const std::exception& error) {
    run.fail(error);
  }
  return run.result();
}

}  // namespace perilink
