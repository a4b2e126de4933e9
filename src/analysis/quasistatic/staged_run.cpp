#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/quasistatic/event_run.hpp"
#include "analysis/quasistatic/residual_strength.hpp"
#include "base/error.hpp"

namespace perilink {

/// Runs stage after stage until the last one is done, the body collapses or a signal stops the run.
DamageResult EventRun::by_stages() {
  if (options_.new_motion) throw SolverError("new_motion cannot be used in a run by stages");
  for (std::size_t k = 0; k < options_.stages.size(); ++k) {
    begin_stage(k);
    const bool goes_on = follow_stage(options_.stages[k]);
    end_stage();
    if (!goes_on) break;
  }
  return finish();
}

/// Starts a stage: the growing and the constant loads change, the equilibrium stays.
void EventRun::begin_stage(std::size_t number) {
  const StageRules& stage = options_.stages[number];
  const bool others = number == 0 || stage.set != options_.stages[number - 1].set;
  result_.stages.emplace_back();
  row_.stage = static_cast<Index>(number + 1);
  stop_ = &stage.stop;
  rows_below_ = 0;
  strains_.restart();
  const bool flowed = number > 0 && staged_->leave_flow();
  if (!others && !flowed) return;
  if (others) {
    result_.peaks = {};
    rows_.clear();
  }
  reference_ = &problem_.sets[stage.set].reference;
  const Unknowns& held = problem_.sets[stage.set].unknowns;
  const bool is_embedded = host_release_ && staged_->is_new(stage.set);
  staged_->begin_stage(stage.set, is_embedded ? host_release_->hold(held) : held);
  begin_work();
  check();
  energy_.begin_stage(staged_->load_factor(), engine_->load_work(), flowed);
}

void EventRun::end_stage() {
  StageResult& stage = result_.stages.back();
  stage.termination = result_.termination;
  stage.reason = result_.reason;
  stage.last = row_;
  find_peaks(network_, rows_, result_);
  stage.peak = {result_.peak_displacement, result_.peak_load};
  stage.largest = result_.peaks.highest();
  stage.smoothed_peak_load = result_.smoothed_peak_load;
}

/// Returns the load factor at which a stage ends if no element fails; none for a stage by events.
std::optional<double> EventRun::end_of(const StageRules& stage, const LoadWork& work) const {
  if (!stage.to_load) return stage.to;
  const double reference = reference_->value;
  if (!reference_->driven) return *stage.to_load / reference;
  const double constant = work.constant.growing_supports - work.constant.forces_on_clamps;
  return (*stage.to_load * reference - constant) / work.supports;
}

/// Runs a stage.
/// \return whether the run goes on after it
bool EventRun::follow_stage(const StageRules& stage) {
  while (true) {
    const LoadWork work = engine_->load_work();
    if (work.separated) {
      record_separated(staged_->load_factor(), work);
      // A block that rocks under its weight still carries a load.
      constexpr double round_off = 1e-9;
      if (std::abs(row_.load) > round_off * std::abs(result_.peak_load)) {
        end(Termination::collapsed,
            fmt::format("a mechanism: constant loads keep the load at {:.6g} at any further "
                        "displacement",
                        row_.load));
      } else if (stage.to_load) {
        end(Termination::collapsed,
            fmt::format("the body no longer resists the displacements: it cannot carry the load "
                        "{}",
                        *stage.to_load));
      }
      return false;
    }
    const std::optional<double> aim = end_of(stage, work);
    const Event event = aim ? staged_->next_event_towards(*aim) : engine_->next_event();
    const bool arrived = event.element == no_index;
    if (!arrived && converts(event, aim && *aim < staged_->load_factor() ? -1.0 : 1.0)) continue;
    if (arrived && !aim) {
      end(Termination::nothing_breaks, "no bond can break under this load");
      return false;
    }
    const double load_factor = arrived ? *aim : event.load_factor;
    const double before = staged_->load_factor();
    staged_->move_to(load_factor);
    if (arrived) {
      // A prescribed load stays in the result, with a warning.
      result_.beyond_small_strains |= is_beyond_small_strains(load_factor);
    } else if (leaves_small_strains(event)) {
      staged_->move_to(before);
      if (aim) note_overload(load_factor);
      return false;
    }
    row_.at_constant_load = event.at_constant_load ? 1 : 0;
    row_.side_change = event.changes_side ? 1 : 0;
    record(load_factor, work, event);
    if (stop_rule_met()) return result_.termination == Termination::completed;
    if (arrived) {
      end(Termination::completed, stage.to ? fmt::format("the load factor reached {}", *stage.to)
                                           : fmt::format("the load reached {}", *stage.to_load));
      return true;
    }
    if (!pass(event)) {
      if (aim) note_overload(load_factor);
      return false;
    }
  }
}

/// Adds the contribution of permanent loads to the axes and the largest energy of a row.
void EventRun::measure_permanent(const LoadWork& work) {
  const double growing = row_.load_factor * work.forces + work.constant.growing_forces;
  if (reference_->driven) {
    row_.load +=
        (work.constant.growing_supports - work.constant.forces_on_clamps) / reference_->value;
  } else {
    row_.displacement = growing / reference_->value;
  }
  most_work_ = std::max(
      {most_work_, std::abs(row_.external_work), row_.strain_energy, row_.dissipated_energy});
}

}  // namespace perilink
