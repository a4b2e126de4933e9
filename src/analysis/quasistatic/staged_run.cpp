#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/quasistatic/event_run.hpp"
#include "analysis/quasistatic/residual_strength.hpp"
#include "base/error.hpp"

namespace perilink {

/// Goes to the next row, of the present stage or a later one.
/// \return false at the end of the run
bool EventRun::by_stages() {
  if (const auto event = std::exchange(path_.pending, std::nullopt)) {
    if (!leave_row(*event)) return false;
  }
  if (path_.position == options_.stages.size()) return false;
  if (!path_.in_stage) begin_stage();
  if (follow_stage()) return true;
  end_stage();
  return false;
}

/// Ends the stage after its last row, else applies the event of the row.
/// \return false at the end of the run
bool EventRun::leave_row(const Event& event) {
  const StageRules& rules = stage();
  if (!stop_rule_met()) {
    if (event.element != no_index) {
      if (pass(event)) return true;
      if (rules.to || rules.to_load) note_overload(path_.row.load_factor);
      end_stage();
      return false;
    }
    end(Termination::completed, rules.to ? fmt::format("the load factor reached {}", *rules.to)
                                         : fmt::format("the load reached {}", *rules.to_load));
  }
  end_stage();
  ++path_.position;
  path_.in_stage = false;
  return path_.result.termination == Termination::completed;
}

/// Sets the reference load and the stop rules of the present stage.
void EventRun::follow_rules() {
  reference_ = &problem_.sets[stage().set].reference;
  stop_ = &stage().stop;
}

/// Starts a stage: the growing and the constant loads change, the equilibrium stays.
void EventRun::begin_stage() {
  const std::size_t number = path_.position, set = stage().set;
  const bool others = number == 0 || set != options_.stages[number - 1].set;
  path_.in_stage = true;
  path_.result.stages.emplace_back();
  path_.row.stage = static_cast<Index>(number + 1);
  path_.rows_below = 0;
  path_.strains.restart();
  follow_rules();
  const bool flowed = number > 0 && staged_->leave_flow();
  if (!others && !flowed) return;
  if (others) {
    path_.result.peaks = {};
    path_.rows.clear();
  }
  const Unknowns& held = problem_.sets[set].unknowns;
  const bool is_embedded = host_release_ && staged_->is_new(set);
  staged_->begin_stage(set, is_embedded ? host_release_->hold(held) : held);
  begin_work();
  check();
  path_.energy.begin_stage(staged_->load_factor(), engine_->load_work(), flowed);
}

void EventRun::end_stage() {
  StageResult& stage = path_.result.stages.back();
  stage.termination = path_.result.termination;
  stage.reason = path_.result.reason;
  stage.last = path_.row;
  find_peaks(network_, path_.rows, path_.result);
  stage.peak = {path_.result.peak_displacement, path_.result.peak_load};
  stage.largest = path_.result.peaks.highest();
  stage.smoothed_peak_load = path_.result.smoothed_peak_load;
}

/// Returns the load factor at which a stage ends if no element fails; none for a stage by events.
std::optional<double> EventRun::end_of_stage(const LoadWork& work) const {
  const StageRules& rules = stage();
  if (!rules.to_load) return rules.to;
  const double reference = reference_->value;
  if (!reference_->driven) return *rules.to_load / reference;
  const double constant = work.constant.growing_supports - work.constant.forces_on_clamps;
  return (*rules.to_load * reference - constant) / work.supports;
}

/// Goes to the next row of a stage.
/// \return false if the stage ends without a further row, and the run with it
bool EventRun::follow_stage() {
  LoadWork work;
  Event event;
  std::optional<double> aim;
  do {
    work = engine_->load_work();
    if (work.separated) {
      record_separated(staged_->load_factor(), work);
      note_mechanism();
      end_stage();
      return true;
    }
    aim = end_of_stage(work);
    event = aim ? staged_->next_event_towards(*aim) : engine_->next_event();
  } while (event.element != no_index &&
           converts(event, aim && *aim < staged_->load_factor() ? -1.0 : 1.0));
  if (missed_) return false;
  const bool arrived = event.element == no_index;
  if (arrived && !aim) {
    end(Termination::nothing_breaks, "no bond can break under this load");
    return false;
  }
  const double load_factor = arrived ? *aim : event.load_factor;
  const double before = staged_->load_factor();
  staged_->move_to(load_factor);
  if (arrived) {
    // A prescribed load stays in the result, with a warning.
    path_.result.beyond_small_strains |= is_beyond_small_strains(load_factor);
  } else if (leaves_small_strains(event)) {
    staged_->move_to(before);
    if (aim) note_overload(load_factor);
    return false;
  }
  path_.row.at_constant_load = event.at_constant_load ? 1 : 0;
  path_.row.side_change = event.changes_side ? 1 : 0;
  record(load_factor, work, event);
  path_.pending = std::move(event);
  return true;
}

/// Sets the reason of a run that ends as the body no longer resists the displacements.
void EventRun::note_mechanism() {
  // A block that rocks under its weight still carries a load.
  constexpr double round_off = 1e-9;
  if (std::abs(path_.row.load) > round_off * std::abs(path_.result.peak_load)) {
    end(Termination::collapsed,
        fmt::format("a mechanism: constant loads keep the load at {:.6g} at any further "
                    "displacement",
                    path_.row.load));
  } else if (stage().to_load) {
    end(Termination::collapsed,
        fmt::format("the body no longer resists the displacements: it cannot carry the load {}",
                    *stage().to_load));
  }
}

/// Adds the contribution of permanent loads to the axes and the largest energy of a row.
void EventRun::measure_permanent(const LoadWork& work, StepRecord& row) {
  const double growing = row.load_factor * work.forces + work.constant.growing_forces;
  if (reference_->driven) {
    row.load +=
        (work.constant.growing_supports - work.constant.forces_on_clamps) / reference_->value;
  } else {
    row.displacement = growing / reference_->value;
  }
  path_.most_work = std::max(
      {path_.most_work, std::abs(row.external_work), row.strain_energy, row.dissipated_energy});
}

}  // namespace perilink
