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
      : input_(input),
        options_(options),
        moments_(stiffness.bending.empty() ? Moments::none : Moments::exact),
        reduced_(orbits != nullptr),
        penalty_(!in_space() && (irregular() || input.give_up) ? force_penalty : no_penalty),
        // Corners may be infeasible: a coarse solution shows it, and an exact one is expensive.
        first_tolerance_(in_space() && !(reduced_ && input.box) ? coarse_tolerance
                                                                : options.tolerance),
        presolves_(presolves && in_space() && !irregular() && moments_ == Moments::none),
        fits_energies_(irregular()),
        equations_(input, options.least_weight, facets, stiffness, orbits) {}

  CalibrationReport run();
  CalibrationEquations::State result() const { return equations_.save(); }
  /// Whether variables fixed at zero were dropped and this reduced the unbalanced forces.
  bool presolves() const { return presolves_; }

 private:
  /// Exact penalty on residuals of forces and moments. Multipliers of feasible equations are up to
  /// 1e3.
  static constexpr double force_penalty = 1e5;
  static constexpr double no_penalty = std::numeric_limits<double>::infinity();

  /// How moments of the particles are balanced.
  enum class Moments { none, exact, soft };

  bool in_space() const { return input_.particles.dim == 3; }
  bool irregular() const { return input_.all_free(); }
  double unbalanced() const {
    return moments_ == Moments::soft ? report_.residual_after
                                     : std::max(report_.residual_after, report_.moment_after);
  }
  /// Measure to compare two solutions: penalties reduce the sum of the unbalanced forces, least
  /// squares roughly the largest.
  double left() const {
    return penalty_ != no_penalty && moments_ != Moments::soft ? report_.sum_after : unbalanced();
  }
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
  void balance_by(Method method, double tolerance);
  bool balance(double tolerance);

  const CalibrationInput& input_;
  const CalibrationOptions& options_;
  Moments moments_;
  bool reduced_;            // symmetry-reduced
  double penalty_;          // exact penalty on residuals; infinity: least squares
  double first_tolerance_;  // of the first solution
  bool presolves_;          // drops variables that are fixed at zero
  bool fits_energies_;      // has equations of the energies of dilatation
  int searches_ = 0, refinements_ = 0;
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
