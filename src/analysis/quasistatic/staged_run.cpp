#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/quasistatic/event_run.hpp"
#include "analysis/quasistatic/residual_strength.hpp"
#include "base/error.hpp"

namespace perilink {
namespace {

/// Returns the load factor at which a stage ends if no element fails; none for a stage by events.
std::optional<double> end_of_stage(const StageRules& rules, const ReferenceLoad& load,
                                   const LoadWork& work) {
  if (!rules.to_load) return rules.to;
  const double reference = load.value;
  if (!load.driven) return *rules.to_load / reference;
  const double constant = work.constant.growing_supports - work.constant.forces_on_clamps;
  return (*rules.to_load * reference - constant) / work.supports;
}

/// Sets the reason of a run that ends as the body no longer resists the displacements.
void note_mechanism(PathState& path, const StageRules& stage) {
  // A block that rocks under its weight still carries a load.
  constexpr double round_off = 1e-9;
  if (std::abs(path.row.load) > round_off * std::abs(path.result.peak_load)) {
    path.end(Termination::collapsed,
             fmt::format("a mechanism: constant loads keep the load at {:.6g} at any further "
                         "displacement",
                         path.row.load));
  } else if (stage.to_load) {
    path.end(
        Termination::collapsed,
        fmt::format("the body no longer resists the displacements: it cannot carry the load {}",
                    *stage.to_load));
  }
}

}  // namespace

void end_stage(PathState& path, const Network& network) {
  StageResult& stage = path.result.stages.back();
  stage.termination = path.result.termination;
  stage.reason = path.result.reason;
  stage.last = path.row;
  find_peaks(network, path.rows, path.result);
  stage.peak = {path.result.peak_displacement, path.result.peak_load};
  stage.largest = path.result.peaks.highest();
  stage.smoothed_peak_load = path.result.smoothed_peak_load;
}

/// Goes to the next row, of the present stage or a later one.
/// \return false at the end of the run
bool EventRun::by_stages() {
  if (const auto event = std::exchange(path_.pending, std::nullopt)) {
    if (!leave_row(*event)) return false;
  }
  if (path_.position == options_.stages.size()) return false;
  if (!path_.in_stage) begin_stage();
  if (follow_stage()) return true;
  end_stage(path_, network_);
  return false;
}

/// Ends the stage after its last row, else applies the event of the row.
/// \return false at the end of the run
bool EventRun::leave_row(const Event& event) {
  const StageRules& rules = stage();
  if (!stop_rule_met(path_, options_, *stop_)) {
    if (event.element != no_index) {
      if (pass(event)) return true;
      if ((rules.to || rules.to_load) && !reference_->driven) {
        path_.note_overload(path_.row.load_factor);
      }
      end_stage(path_, network_);
      return false;
    }
    if (rules.to) {
      path_.end(Termination::completed, fmt::format("the load factor reached {}", *rules.to));
    } else if (rules.to_load) {
      path_.end(Termination::completed, fmt::format("the load reached {}", *rules.to_load));
    }  // else end_without_event() has set the reason
  }
  end_stage(path_, network_);
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
  path_.largest_of_stage = {};
  path_.strains.restart();
  follow_rules();
  const bool flowed = number > 0 && staged_->leave_flow();
  if (!others && !flowed) return;
  if (others) {
    path_.result.peaks = {};
    path_.largest = {};
    path_.rows.clear();
  }
  const Unknowns& held = problem_.sets[set].unknowns;
  const bool is_embedded = host_release_ && staged_->is_new(set);
  staged_->begin_stage(set, is_embedded ? host_release_->hold(held) : held);
  path_.begin_work(engine_->load_work());
  check();
  path_.energy.begin_stage(staged_->load_factor(), engine_->load_work(), flowed);
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
      note_mechanism(path_, stage());
      end_stage(path_, network_);
      return true;
    }
    aim = end_of_stage(stage(), *reference_, work);
    event = aim ? staged_->next_event_towards(*aim) : engine_->next_event();
  } while (event.element != no_index &&
           converts(event, aim && *aim < staged_->load_factor() ? -1.0 : 1.0));
  if (missed_) return false;
  const bool arrived = event.element == no_index;
  if (arrived && !aim) {
    aim = end_without_event(path_, event, work, *reference_, *stop_, staged_->load_factor());
  }
  if (arrived && !aim) return false;
  const double load_factor = arrived ? *aim : event.load_factor;
  const double before = staged_->load_factor();
  staged_->move_to(load_factor);
  if (arrived) {
    // A prescribed load stays in the result, with a warning.
    path_.result.beyond_small_strains |= is_beyond_small_strains(load_factor);
  } else if (leaves_small_strains(event)) {
    staged_->move_to(before);
    if (aim && !reference_->driven) path_.note_overload(load_factor);
    return false;
  }
  path_.row.at_constant_load = event.at_constant_load ? 1 : 0;
  path_.row.side_change = event.changes_side ? 1 : 0;
  record(load_factor, work, event);
  path_.pending = std::move(event);
  return true;
}

}  // namespace perilink
