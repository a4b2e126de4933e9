#pragma once

#include <span>
#include <vector>

#include "analysis/quasistatic/equilibrium/body/damaged_body.hpp"
#include "analysis/quasistatic/equilibrium/body/event_outcome.hpp"
#include "analysis/quasistatic/equilibrium/displacement/field.hpp"
#include "analysis/quasistatic/equilibrium/update/update.hpp"
#include "network/loaded_network.hpp"

namespace perilink {

/// Constant loads and prescribed motions of a stage.
struct ConstantLoads {
  Unknowns unknowns;  ///< unknowns of the body, with the constant prescribed motions
  Loads loads;
  double load_factor = 0.0;  ///< present load factor of the growing loads
};

/// Permanent loads of a stage and the displacements that they cause in the present body. Total
/// displacements are these plus the load factor times those of the growing loads
/// (docs/theory/events_and_energy.md, section 7).
class PermanentLoad {
 public:
  /// \param growing      unknowns with the growing prescribed motions
  /// \param ground_load  loads of ground springs per unknown; empty: none
  PermanentLoad(const DamagedBody& body, Update& update, ConstantLoads given,
                std::vector<double> ground_load);

  /// Returns the load factor of the growing loads.
  double load_factor() const { return given_.load_factor; }
  void move_to(double load_factor) { given_.load_factor = load_factor; }
  const Unknowns& unknowns() const { return given_.unknowns; }
  /// Changes the unknowns; the prescribed motions stay.
  void set_unknowns(const Unknowns& unknowns);
  /// Returns whether there are no constant loads and no constant motions.
  bool rests() const { return rests_; }

  const Field& field() const { return field_; }
  /// Sets a solution.
  void set_values(std::vector<double> values);

  /// Solves for the displacements.
  void refresh();
  /// Finds the displacements from the last ones by conjugate gradients.
  /// \return false if they do not converge
  bool search();
  /// Follows a removal whose deformation is known; precedes its effect on K^-1.
  void follow(const Removal& removal);
  /// Adds a multiple of a motion of the unknowns; apply() must follow.
  void add(double factor, std::span<const double> motion) { field_.add(factor, motion); }
  /// Adds K^-1 forces; apply() must follow.
  void add_solution(const SparseVector& forces);
  /// Computes the displacements from the solution.
  void apply();
  void add_ground_spring(Index unknown, double stiffness) {
    field_.add_ground_spring(unknown, stiffness);
  }

  /// Returns the contribution to the work products.
  /// \param loads         growing loads
  /// \param displacement  by the growing loads
  ConstantWork work(const Loads& loads, std::span<const double> displacement) const;
  /// Returns the forces on the unknowns, without those of prescribed motions.
  std::vector<double> forces() const { return field_.forces(given_.unknowns, given_.loads); }
  /// \param internal  receives the forces of the elements
  Residual residual(InternalForce& internal) const {
    return field_.residual(body_, given_.unknowns, given_.loads, internal);
  }

 private:
  void find_driven_slots();
  std::vector<double> load() const { return field_.load(body_, given_.unknowns, given_.loads); }

  const DamagedBody& body_;
  Update& update_;
  ConstantLoads given_;
  Field field_;
  std::vector<std::size_t> driven_slots_;  ///< slots with constant or growing prescribed motions
  std::vector<Index> driven_elements_;     ///< elements with an end at such a slot
  bool rests_ = true;
};

}  // namespace perilink
