#pragma once

#include "analysis/quasistatic/equilibrium/equilibrium.hpp"

namespace perilink {

/// Energies along straight lines between the rows of a history. Between load factors lambda_k and
/// lambda_(k+1) the work of the loads is a sum of trapezoids. The event between them dissipates
/// lambda_k lambda_(k+1) (C_(k+1) - C_k) / 2, where C is the compliance f'u - R'd at load factor 1.
/// Then work = stored + dissipated holds exactly. C also grows without an event when new unknowns
/// make particles freer. The stored energy then falls by the constraint energy, an error of the
/// former unknowns. It is kept apart: work = stored + dissipated + freed.
class PathEnergy {
 public:
  /// Moves along the path to the next row.
  void advance(double load_factor, const LoadWork& work) {
    external_ += 0.5 * (load_factor_ + load_factor) *
                     (load_factor * work.forces - load_factor_ * work_.forces) +
                 0.5 * (load_factor_ * work_.supports + load_factor * work.supports) *
                     (load_factor - load_factor_);
    dissipated_ += 0.5 * load_factor_ * load_factor * growth_;
    freed_ += 0.5 * load_factor_ * load_factor * freedom_.growth;
    advance_permanent(load_factor, work.constant);
    growth_ = 0.0;
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
    released_ += load_factor_ * load_factor_ * outcome.released;
    released_ += outcome.released_by_permanent.at(load_factor_);
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
    archive(load_factor_, work_, growth_, freedom_, permanent_growth_, external_, dissipated_,
            freed_, released_);
  }

 private:
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
  Freedom freedom_;  ///< growth of the compliance since the present row, as particles became freer
  Beside permanent_growth_;
  double external_ = 0.0;
  double dissipated_ = 0.0;
  double freed_ = 0.0;
  double released_ = 0.0;
};

}  // namespace perilink
