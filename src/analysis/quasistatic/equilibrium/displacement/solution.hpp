#pragma once

#include <optional>
#include <vector>

#include "analysis/quasistatic/equilibrium/displacement/growing_load.hpp"
#include "analysis/quasistatic/equilibrium/displacement/permanent_load.hpp"

namespace perilink {

/// Displacements of a damaged body and how they follow from K^-1: those of the growing loads, and
/// in stages those of permanent loads.
class Solution {
 public:
  /// \param ground_load  loads of ground springs per unknown; empty: none
  Solution(const DamagedBody& body, Update& update, const Loads& loads,
           std::vector<double> ground_load)
      : body_(body), update_(update), growing_(body, update, loads, std::move(ground_load)) {}

  const DamagedBody& body() const { return body_; }
  const GrowingLoad& growing() const { return growing_; }
  GrowingLoad& growing() { return growing_; }
  /// Returns the permanent loads; null without stages.
  const PermanentLoad* permanent() const { return permanent_ ? &*permanent_ : nullptr; }
  PermanentLoad* permanent() { return permanent_ ? &*permanent_ : nullptr; }
  Update& update() { return update_; }
  const Update& update() const { return update_; }

  /// Returns the contribution of permanent loads to the work products.
  ConstantWork constant_work() const;
  /// Returns the largest error of displacement differences, also between particles at rest, caused
  /// by motion elsewhere in the body [length]. Zero for trusses with a factor.
  double noise() const { return 1e-12 * growing_.field().largest_motion; }
  /// Returns noise() after events, whose errors the next check may remove [length].
  double noise_of_events() const;

  /// Makes K^-1 for new unknowns.
  /// \param resists  see Update::begin()
  /// \param all      keeps all displacements current
  void begin(bool resists, bool all);
  /// Replaces the loads by others that grow in addition to permanent ones. Ground springs hold
  /// loose parts at their present positions.
  void begin_stage(const Loads& loads, ConstantLoads given);
  void add_ground_spring(Index unknown, double stiffness);

  /// Finds the displacements under new loads.
  /// \return residual over the load before one step of refinement
  double find();
  /// Solves for all displacements.
  void refresh();
  /// Makes K^-1 anew and solves for all displacements.
  void renew();
  /// Makes K^-1 anew if it lags behind the secants.
  void bring_inverse_up();
  /// Solves for all displacements if some are not current.
  void make_current();
  /// Keeps all displacements current from now on.
  void keep_all_current();
  /// Finds all displacements from the last ones by conjugate gradients.
  /// \return false if they do not converge
  bool search();
  /// Changes K^-1 by a removal, and the displacements with it.
  void follow(const Removal& removal);
  /// Updates the displacements for forces that elements no longer carry, by K^-1 after the change.
  void follow_forces(const ForceOfElements& forces);

  /// Displacements before a batch.
  struct Saved {
    std::vector<double> growing, permanent;
    double work;  ///< GrowingLoad::work()
  };
  Saved save() const;
  /// Returns to displacements before a batch, whose secants K has again.
  void take_back(Saved saved);

 private:
  void apply_to_part();

  const DamagedBody& body_;
  Update& update_;
  GrowingLoad growing_;
  std::optional<PermanentLoad> permanent_;
};

}  // namespace perilink
