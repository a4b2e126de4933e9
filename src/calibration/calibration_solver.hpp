#pragma once

#include <limits>
#include <vector>

#include "calibration/bond_orbits.hpp"
#include "calibration/bounded_least_squares/bounded_least_squares.hpp"
#include "calibration/calibration_equations.hpp"
#include "calibration/calibration_input.hpp"

/// \file The attempts of calibrate_bonds().

namespace perilink {

/// Tolerance of the first solution where a smaller one is expensive.
inline constexpr double coarse_tolerance = 1e-6;

/// In space, solutions are repeated until unbalanced forces and moments are below this.
inline constexpr double exact_balance = 1e-10;

/// Finds weights with balanced forces and moments at every particle. The attempts are made in this
/// order; "forces" are the unbalanced forces.
///
/// | attempt | accepted where | then | else |
/// |---|---|---|---|
/// | fix_zeros | forces < 1e-4, no particle loses half of its bonds | remove_floors | keep_floors |
/// | keep_floors | forces are smaller than before | remove_floors | failed |
/// | remove_floors | a particle is out of balance | done | from_multipliers |
/// | from_multipliers | forces are smaller than before | from_weights | from_weights |
/// | from_weights | forces are halved, three times at most | from_weights | done |
///
/// fix_zeros drops the variables that an equation fixes at zero, in lattices in space without
/// moments. remove_floors allows bonds of unbalanced particles to fall to zero, and restores the
/// lower bounds where the forces do not fall to a tenth. The last two are made in space only.
///
/// Each attempt is solved by Newton's method on the dual. The interior-point method follows where
/// forces remain, and is the first for unstructured particle sets in space. After failed attempts
/// the energies of dilatation are left out. Unbalanced micropolar bodies are solved again with soft
/// moments. The best balanced state is kept.
class CalibrationSolver {
 public:
  /// \param orbits     symmetry-equivalent bonds of a reduced problem; nullptr: unreduced
  /// \param presolves  whether to drop variables that are fixed at zero, in lattices in space
  ///                   without moments
  CalibrationSolver(const CalibrationInput& input, const CalibrationOptions& options,
                    const Facets& facets, const BondStiffness& stiffness, const BondOrbits* orbits,
                    bool presolves)
      : in_space_(input.particles.dim == 3),
        irregular_(input.all_free()),
        penalised_(!in_space_ && (irregular_ || input.give_up)),
        reduced_(orbits != nullptr),
        cautious_(in_space_ && !(reduced_ && input.box)),
        presolves_(presolves && in_space_ && !irregular_ && stiffness.bending.empty()),
        moments_(!stiffness.bending.empty()),
        tolerance_(options.tolerance),
        on_search_(options.on_search),
        energies_(irregular_),
        equations_(input, options.least_weight, facets, stiffness, orbits) {}

  CalibrationReport run();
  CalibrationEquations::State result() const { return equations_.save(); }
  /// Whether variables fixed at zero were dropped and this reduced the unbalanced forces.
  bool presolves() const { return presolves_; }

 private:
  double unbalanced() const {
    return soft_moments_ ? report_.residual_after
                         : std::max(report_.residual_after, report_.moment_after);
  }
  /// Measure to compare two solutions: penalties reduce the sum of the unbalanced forces, least
  /// squares roughly the largest.
  double left() const { return penalised_ && !soft_moments_ ? report_.sum_after : unbalanced(); }
  /// Rows of the table of attempts, and their ends.
  enum class Step {
    fix_zeros,
    keep_floors,
    remove_floors,
    from_multipliers,
    from_weights,
    done,
    failed
  };
  LeastSquaresResult solve_least_squares(PointEquations equations, LeastSquaresOptions options);
  double first_tolerance() const { return cautious_ ? coarse_tolerance : tolerance_; }
  void settle();
  bool fix_zero_variables();
  bool keep_floors();
  bool remove_floors();
  void balance_without_dropped();
  bool go_on_from_multipliers();
  bool go_on_from_weights();
  bool make_attempts();
  template <class Measure, class Run>
  void keep_if_nearer(Measure measure, Run run);
  void fit_energies();
  void balance_by(Method method, double charge, double tolerance);
  bool balance(double tolerance);

  bool in_space_, irregular_;
  bool penalised_;  // residuals have an exact penalty in place of least squares
  bool reduced_;
  /// Corners may be infeasible: a coarse solution shows it, and an exact one is expensive.
  bool cautious_;
  bool presolves_;  // drops variables that are fixed at zero
  bool moments_;
  double tolerance_;
  CalibrationObserver on_search_;
  int searches_ = 0, refinements_ = 0;
  bool energies_;  // whether equations of the energies of dilatation are used
  bool soft_moments_ = false;
  int stalled_search_ = 0;  // number of the last solution that ended with short steps
  double infeasible_above_ = std::numeric_limits<double>::infinity();  // ends a solution
  CalibrationEquations equations_;
  CalibrationEquations::State settled_;  // state before the exact forces
  std::vector<double> multipliers_;      // of the last solution for the exact forces
  std::vector<double> start_;            // multipliers to start from; empty: zero
  CalibrationReport report_;
  KeptPreconditioner kept_;  // for the force equations
};

}  // namespace perilink
