#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "analysis/quasistatic/equilibrium/body/event_outcome.hpp"
#include "analysis/quasistatic/equilibrium/displacement/element_deformations.hpp"
#include "analysis/quasistatic/equilibrium/displacement/solution.hpp"

namespace perilink {

/// Elements that lose stiffness at once, and the body before. One equilibrium follows from a change
/// of K^-1, from a new one, or from conjugate gradients preconditioned by an older one
/// (docs/theory/events_and_energy.md, section 8).
class EventBatch {
 public:
  EventBatch(DamagedBody& body, Solution& solution, std::span<const Weakening> changes);

  /// Weakens the elements and finds their equilibrium.
  /// \return whether the batch leaves an equilibrium that surely resists; else take_back() must
  ///         follow
  bool apply(EventOutcome& outcome);
  /// Returns whether K^-1 has followed the batch by a change. Then f'u follows from the growth of
  /// the compliance.
  bool changed_inverse() const { return way_ == Way::change; }
  /// Restores the body before the batch.
  /// \param settled  contact states have changed since
  void take_back(bool settled);

 private:
  /// An element before the batch.
  struct Member {
    Weakening change;
    Removal removal;
    Removal::Deformations growing;  ///< deformation by growing loads
    Removal::Deformations beside;   ///< x'u by permanent loads
    double secant;
    bool was_intact;
  };
  double weaken(EventOutcome& outcome);
  bool follow(double& pivot);
  bool change_inverse(double& pivot);
  bool resists();
  void add_growth(const Member& member, EventOutcome& outcome) const;

  DamagedBody& body_;
  Solution& solution_;
  std::vector<Member> members_;
  Solution::Saved before_;
  bool lagged_;                 ///< K^-1 belonged to an even earlier body
  bool keeps_inverse_ = false;  ///< K^-1 is unchanged
  Way way_ = Way::change;
};

}  // namespace perilink
