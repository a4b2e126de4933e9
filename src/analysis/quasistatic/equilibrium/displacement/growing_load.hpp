#pragma once

#include <span>
#include <vector>

#include "analysis/quasistatic/equilibrium/displacement/current_part.hpp"
#include "analysis/quasistatic/equilibrium/displacement/field.hpp"
#include "analysis/quasistatic/equilibrium/update/update.hpp"

namespace perilink {

/// Growing loads and the displacements that they cause in the present body at load factor 1. Events
/// may keep only a part of the displacements current.
class GrowingLoad {
 public:
  /// \param ground_load  loads of ground springs per unknown; empty: none
  GrowingLoad(const DamagedBody& body, Update& update, const Loads& loads,
              std::vector<double> ground_load);

  const Loads& loads() const { return *loads_; }
  /// Returns the solution. Its displacements are current wherever an element can fail; others may
  /// belong to an earlier event.
  const Field& field() const { return field_; }
  /// Returns displacements that are current everywhere. Costs a solve if some are not.
  /// \param earlier    displacements of an earlier state that events kept current in a part; empty:
  ///                   those of the present state
  /// \param secants    of the earlier state
  /// \param tolerance  residual over the load below which the earlier ones are current
  std::span<const double> displacement(std::span<const double> earlier = {}, Secants secants = {},
                                       double tolerance = 0.0);
  /// Returns whether all displacements are current.
  bool is_current() const { return !stale_; }
  /// Returns whether events keep all displacements current.
  bool is_whole() const { return part_.is_all(); }
  /// Returns whether residual_of_part() checks some unknowns.
  bool has_checked_part() const { return part_.can_be_checked(); }

  /// Returns f'u: applied forces times displacements.
  double work() const { return part_.is_all() ? sum_work() : work_; }
  /// Adds the growth of f'u by an event.
  void add_work(double growth) { work_ += growth; }

  /// Begins with the present unknowns at zero.
  void begin();
  /// Selects the displacements that events keep current: all, or the ends of elements that can
  /// fail.
  void select(bool all);
  /// Changes the loads, and takes the prescribed motions of the unknowns.
  void set_loads(const Loads& loads);
  void set_ground_load(std::vector<double> load) { field_.ground_load = std::move(load); }
  void add_ground_spring(Index unknown, double stiffness) {
    field_.add_ground_spring(unknown, stiffness);
  }
  /// Measures the load, to which residuals relate from now on.
  void measure_load();

  /// Solves for all displacements.
  void refresh();
  Residual residual() { return field_.residual(body_, body_.unknowns(), *loads_, internal_); }
  /// Returns the residual of the current part over the load.
  double residual_of_part();
  /// Makes one step of iterative refinement; the residual becomes the correction.
  void refine(Residual& residual);
  /// Finds all displacements from the last ones by conjugate gradients.
  /// \return false if they do not converge
  bool search();
  /// Corrects the solution.
  void correct(std::span<const double> correction);
  /// Sets the solution.
  void set_values(std::vector<double> values);
  /// Returns to displacements before a batch.
  /// \param work  f'u
  void take_back(std::vector<double> values, double work);

  /// Adds a multiple of a motion of the unknowns; apply_to_part() must follow.
  void add(double factor, std::span<const double> motion) { field_.add(factor, motion); }
  /// Changes K^-1 by a removal, and the solution with it; apply_to_part() must follow.
  void follow(const Removal& removal);
  /// Adds K^-1 forces; apply_to_part() must follow.
  void add_solution(const SparseVector& forces);
  /// Computes the displacements that events keep current.
  void apply_to_part();

 private:
  double sum_work() const;
  void apply();
  void find_largest_motion();

  const DamagedBody& body_;
  Update& update_;
  const Loads* loads_;
  Field field_;
  std::vector<std::size_t> loaded_slots_;
  CurrentPart part_;
  bool stale_ = false;              ///< displacements outside the part belong to an earlier event
  double work_ = 0.0;               ///< f'u, updated at events
  std::vector<double> everywhere_;  ///< displacements for observers, while some are not current
  InternalForce internal_;          ///< memory that checks reuse
};

}  // namespace perilink
