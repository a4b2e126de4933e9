#pragma once

#include <memory>
#include <optional>
#include <span>

#include "analysis/quasistatic/equilibrium/body/damaged_body.hpp"
#include "analysis/quasistatic/equilibrium/body/element_state.hpp"
#include "analysis/quasistatic/equilibrium/body/event_outcome.hpp"
#include "analysis/quasistatic/equilibrium/contact_changes.hpp"
#include "analysis/quasistatic/equilibrium/displacement/solution.hpp"
#include "analysis/quasistatic/equilibrium/reaction_work.hpp"
#include "analysis/quasistatic/equilibrium/separation.hpp"
#include "analysis/quasistatic/equilibrium/update/make_update.hpp"
#include "base/error.hpp"
#include "network/loaded_network.hpp"

namespace perilink {

/// Thrown if initial cracks have cut off a piece that the first loads pull away.
class CracksSeparate : public SolverError {
 public:
  CracksSeparate() : SolverError("cracks have separated the body, and the loads pull it apart") {}
};

/// Equilibrium of a network at load factor 1 while its elements lose stiffness. Conducts events
/// through its parts, and checks the accuracy of the displacements. All event engines are built on
/// it.
class Equilibrium {
 public:
  /// \param unknowns  motion of the particles, must outlive this object; null: as the problem says
  /// \param saved     state of this network with these unknowns; null: the intact body
  /// \throws SolverError if the stiffness matrix is not positive definite
  /// \throws std::invalid_argument if conjugate gradients are asked for and particles are embedded
  Equilibrium(const LoadedNetwork& problem, const EquilibriumOptions& options,
              const Unknowns* unknowns = nullptr, const ElementState* saved = nullptr);

  ElementState state() const;

  const Update& update() const { return *update_; }
  const Solution& solution() const { return solution_; }
  const Contact& contact() const { return sides_.contact(); }

  /// Returns the present stiffness of every element over its intact stiffness.
  Secants secants() const { return body_.secants(); }

  /// Returns displacements at load factor 1, rotations included, shape (particles, width). They are
  /// current wherever an element can fail; others may belong to an earlier event.
  std::span<const double> where_elements_fail() const {
    return solution_.growing().field().displacement;
  }

  /// Returns displacements at load factor 1, current everywhere. Costs a solve if some are not.
  /// \param earlier  where_elements_fail() of an earlier state with these unknowns, which is then
  ///                 made current; empty: the present state
  /// \param secants  of the earlier state
  std::span<const double> displacement(std::span<const double> earlier = {}, Secants secants = {});

  LoadWork work();

  /// Reduces the secant of an element; zero breaks it. Damaged bonds then close in compression and
  /// open in tension.
  /// \throws SolverError if the contact states do not settle
  EventOutcome weaken(Index element, double secant);

  /// Reduces the secants of elements at once, with one solve for all. K^-1 is changed, made anew or
  /// kept as a preconditioner, whichever costs least.
  /// \return nothing if elements must fail one by one to show whether the body survives; then all
  ///         is unchanged
  std::optional<EventOutcome> weaken_together(std::span<const Weakening> changes);

  /// Changes the contact states of damaged bonds with zero extension according to the direction of
  /// the load.
  /// \param direction  1 if the load factor grows, -1 if it falls
  EventOutcome pass_side_change(double direction);

  /// Removes an element in any case. A part that comes loose without load is held by ground
  /// springs, one per rigid-body mode, added before the removal. The rest of the body keeps its
  /// exact equilibrium.
  /// \return number of ground springs added
  /// \throws SolverError if a loaded part comes loose
  int cut(Index element);

  /// Makes a full residual check. Above the tolerance, refines the displacements once, then makes
  /// K^-1 anew.
  Balance check();

  /// Makes a cheap residual check where elements can fail, without a solve. Above the tolerance,
  /// calls check().
  /// \return balance whose stored energy is not a number if some displacements are not current
  Balance check_cheaply();

  /// Changes the unknowns that move the particles. Loads, secants and prescribed motions stay.
  /// \param unknowns  must outlive this object
  /// \return growth of the compliance, positive if particles became freer
  /// \throws SolverError while ground springs hold a part, or if the new unknowns leave a part
  ///         without support; particles then move as before
  /// \throws std::invalid_argument if prescribed motions differ
  Freedom change_motion(const Unknowns& unknowns);

  /// Calls Update::prepare().
  void prepare(Index element, std::span<const Index> expected) {
    update_->prepare(element, expected);
  }

  /// Starts a stage: other loads and prescribed motions grow, in addition to permanent ones. All
  /// displacements are kept current.
  /// \param unknowns  former unknowns with other motions and possibly more clamps; must outlive
  ///                  this object, as must the loads
  void begin_stage(const Unknowns& unknowns, const Loads& loads, ConstantLoads permanent);

  /// Goes on with a stage of a saved run, after begin_stage(): ground springs keep their loads.
  void go_on(const ElementState& saved);

  /// Restores the intact stiffness of elements at the start of the next stage.
  void restore(std::span<const Index> elements);

  /// Sets the load factor of the growing loads.
  void move_to(double load_factor) { solution_.permanent()->move_to(load_factor); }

 private:
  LoadWork work_of_growing();
  Balance check_growing();
  void check_permanent(Balance& balance);
  Balance refine();
  void adopt_motion(const Unknowns& unknowns, bool resists);
  void follow(const EventOutcome& outcome, bool changed_inverse);
  void commit(const Removal& removal, const Weakening& change);
  bool hold_free_modes(Removal& removal, Index element, double unloaded, int& springs);
  void add_ground_spring(Index unknown);

  /// Residuals that a new K^-1 can reach, over the load.
  struct Reachable {
    double unrefined = 0.0;  ///< before refinement
    double refined = 0.0;    ///< after refinement; 0: the tolerance
    double inverse = 0.0;    ///< SeparationCheck::Refinement::inverse_error
  };

  double tolerance_;  ///< EquilibriumOptions::residual_tolerance
  DamagedBody body_;
  std::unique_ptr<Update> update_;
  Solution solution_;
  ReactionWork work_;
  SeparationCheck separation_;
  ContactChanges sides_;
  Reachable reachable_;
  bool restored_ = false;  ///< elements were restored since K^-1 was made
};

}  // namespace perilink
