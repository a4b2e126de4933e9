#pragma once

#include "analysis/quasistatic/events/event_engine.hpp"

namespace perilink {

/// Energies along the path drawn by straight lines through the rows of a history. Between two rows
/// with load factors lambda_k and lambda_(k+1) the loads do the work of trapezoids; the event
/// between them dissipates lambda_k lambda_(k+1) (C_(k+1) - C_k) / 2, C the compliance f'u - R'd at
/// load factor 1, and work = stored + dissipated holds exactly.
class PathEnergy {
 public:
  /// Moves along the path to the next row.
  void advance(double load_factor, const LoadWork& work) {
    external_ += 0.5 * (load_factor_ + load_factor) *
                     (load_factor * work.forces - load_factor_ * work_.forces) +
                 0.5 * (load_factor_ * work_.supports + load_factor * work.supports) *
                     (load_factor - load_factor_);
    dissipated_ += 0.5 * load_factor_ * load_factor * growth_;
    growth_ = 0.0;
    load_factor_ = load_factor;
    work_ = work;
  }

  /// An event at the present row.
  void add_event(const EventOutcome& outcome) {
    growth_ += outcome.compliance_growth;
    released_ += load_factor_ * load_factor_ * outcome.released;
  }

  double external_work() const { return external_; }
  double dissipated() const { return dissipated_; }
  double released() const { return released_; }
  double stored() const {
    return 0.5 * load_factor_ * load_factor_ * (work_.forces + work_.supports);
  }

 private:
  double load_factor_ = 0.0;
  LoadWork work_;
  double growth_ = 0.0;
  double external_ = 0.0;
  double dissipated_ = 0.0;
  double released_ = 0.0;
};

}  // namespace perilink
