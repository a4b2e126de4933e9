#pragma once

#include <algorithm>

#include "analysis/quasistatic/equilibrium/equilibrium.hpp"
#include "analysis/quasistatic/observer.hpp"

namespace perilink {

/// Returns the energy that a batch dissipates beyond the straight line between two rows. The load
/// on its way lies between that of the row and the lower one at which the weakened elements are
/// strained as they were when they failed. Where the line leaves this range, all elements but the
/// last follow its nearest end.
/// \param events  elements of the batch; single events follow the line
/// \param line    energy along the line [force length]
/// \param held    energy that the elements held when they failed [force length]
/// \param at_row  energy if the load stayed that of the row [force length]
inline double energy_beyond_line(double events, double line, double held, double at_row) {
  const double part = part_at_constant_load(events);
  return part > 0.0 ? part * (std::clamp(line, std::min(held, at_row), at_row) - line) : 0.0;
}

/// Energies along straight lines between the rows of a history. Between load factors lambda_k and
/// lambda_(k+1) the work of the loads is a sum of trapezoids. The event between them dissipates
/// lambda_k lambda_(k+1) (C_(k+1) - C_k) / 2, where C is the compliance f'u - R'd at load factor 1.
/// Then work = stored + dissipated holds exactly. A batch leaves the line, with the same addition
/// to both (energy_beyond_line()). C also grows without an event when new unknowns make particles
/// freer. The stored energy then falls by the constraint energy, an error of the former unknowns.
/// It is kept apart: work = stored + dissipated + freed.
class PathEnergy {
 public:
  /// Moves along the path to the next row.
  void advance(double load_factor, const LoadWork& work) {
    const double beyond = beyond_line(load_factor);
    external_ += 0.5 * (load_factor_ + load_factor) *
                     (load_factor * work.forces - load_factor_ * work_.forces) +
                 0.5 * (load_factor_ * work_.supports + load_factor * work.supports) *
                     (load_factor - load_factor_);
    dissipated_ += 0.5 * load_factor_ * load_factor * growth_;
    freed_ += 0.5 * load_factor_ * load_factor * freedom_.growth;
    advance_permanent(load_factor, work.constant);
    external_ += beyond;
    dissipated_ += beyond;
    growth_ = events_ = held_ = 0.0;
    freedom_ = {};
    load_factor_ = load_factor;
    work_ = work;
  }

  /// Starts a stage: another load case grows, from its own load factor. The equilibrium stays.
  /// \param flowed  bars have flowed: the fall of the stored energy is dissipated
  void begin_stage(double load_factor, const LoadWork& work, bool flowed = false) {
    const double before = stored();
    load_factor_ = load_factor;
    work_ = work;
    if (flowed) dissipated_ += before - stored();
  }

  /// Adds an event at the present row.
  void add_event(const EventOutcome& outcome) {
    growth_ += outcome.compliance_growth;
    permanent_growth_ += outcome.permanent_growth;
    events_ += outcome.broken + outcome.yielded;
    const double by_growing = load_factor_ * load_factor_ * outcome.released;
    const double by_permanent = outcome.released_by_permanent.at(load_factor_);
    held_ += by_growing + by_permanent;
    released_ += by_growing;
    released_ += by_permanent;
  }

  /// Adds the growth of the compliance at the present row as particles became freer.
  void add_freedom(const Freedom& freedom) {
    freedom_.growth += freedom.growth;
    freedom_.beside += freedom.beside;
  }

  double external_work() const { return external_; }
  double dissipated() const { return dissipated_; }
  double released() const { return released_; }
  double freed() const { return freed_; }
  double stored() const {
    const ConstantWork& constant = work_.constant;
    return 0.5 * load_factor_ * load_factor_ * (work_.forces + work_.supports) +
           Beside{constant.forces_on_motion + constant.growing_supports,
                  0.5 * (constant.forces + constant.supports)}
               .at(load_factor_);
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(load_factor_, work_, growth_, events_, held_, freedom_, permanent_growth_, external_,
            dissipated_, freed_, released_);
  }

 private:
  /// Returns what the events since the present row dissipate beyond the line to a load factor.
  double beyond_line(double load_factor) const {
    const auto energy = [&](double next) {
      return 0.5 *
             (load_factor_ * next * growth_ + permanent_growth_.at(0.5 * (load_factor_ + next)));
    };
    return energy_beyond_line(events_, energy(load_factor), held_, energy(load_factor_));
  }
  /// Adds the contribution of permanent loads: their work, and the work of growing loads
  /// on the displacements they cause.
  void advance_permanent(double load_factor, const ConstantWork& after) {
    const ConstantWork& before = work_.constant;
    const double both = load_factor_ + load_factor;
    external_ +=
        (load_factor * after.forces_on_motion + after.forces) -
        (load_factor_ * before.forces_on_motion + before.forces) +
        0.5 * both * (after.growing_forces - before.growing_forces) +
        0.5 * (load_factor - load_factor_) * (before.growing_supports + after.growing_supports);
    dissipated_ += 0.5 * permanent_growth_.at(0.5 * both);
    freed_ += 0.5 * freedom_.beside.at(0.5 * both);
    permanent_growth_ = {};
  }

  double load_factor_ = 0.0;
  LoadWork work_;
  double growth_ = 0.0;  ///< growth of the compliance since the present row
  double events_ = 0.0;  ///< elements that failed since the present row
  double held_ = 0.0;    ///< energy that they held [force length]
  Freedom freedom_;  ///< growth of the compliance since the present row, as particles became freer
  Beside permanent_growth_;
  double external_ = 0.0;
  double dissipated_ = 0.0;
  double freed_ = 0.0;
  double released_ = 0.0;
};

}  // namespace perilink
