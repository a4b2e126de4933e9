#pragma once

#include <limits>
#include <vector>

#include "calibration/bond_orbits.hpp"
#include "calibration/calibration_equations.hpp"
#include "calibration/calibration_input.hpp"
#include "calibration/least_change/least_change.hpp"

/// \file The searches behind calibrate_bonds().

namespace perilink {

/// In space searches are repeated until forces and moments are less out of balance than this.
inline constexpr double exact_balance = 1e-10;

/// Weights for which forces and moments are in balance at every particle: which bonds take part,
/// how many digits are asked for, and what comes next where a search ends elsewhere.
class BalanceSearch {
 public:
  /// \param orbits       where bonds are made alike; nullptr: every bond by itself
  /// \param drops_first  what must vanish is dropped before any search, in lattices
  ///                     in space without moments
  BalanceSearch(const CalibrationInput& input, const CalibrationOptions& options,
                const Facets& facets, const BondStiffness& stiffness, const BondOrbits* orbits,
                bool drops_first)
      : in_space_(input.particles.dim == 3),
        irregular_(input.all_free()),
        priced_(!in_space_ && (irregular_ || input.give_up)),
        tied_(orbits != nullptr),
        cautious_(in_space_ && !(tied_ && input.box)),
        drops_first_(drops_first && in_space_ && !irregular_ && stiffness.bending.empty()),
        moments_(!stiffness.bending.empty()),
        tolerance_(options.tolerance),
        on_search_(options.on_search),
        energies_(irregular_),
        equations_(input, options.least_weight, facets, stiffness, orbits) {}

  /// \param operations  that searches of tied bonds may take
  CalibrationReport run(double operations = std::numeric_limits<double>::infinity());
  CalibrationEquations::State result() const { return equations_.save(); }
  /// Whether what must vanish was dropped, and forces came nearer to balance so.
  bool drops_first() const { return drops_first_; }

 private:
  double unbalanced() const {
    return soft_moments_ ? report_.residual_after
                         : std::max(report_.residual_after, report_.moment_after);
  }
  /// What a search lessens, to compare two ends: prices the sum, least squares about the largest.
  double left() const { return priced_ && !soft_moments_ ? report_.sum_after : unbalanced(); }
  void soften_moments();
  LeastChange find_least_change(PointEquations equations, LeastChangeOptions options);
  void settle();
  bool drop_what_must_vanish();
  void refine();
  bool balance_dropping_bonds();
  void fit_energies();
  void balance_by(Method method, double charge, double tolerance);
  bool balance(double tolerance);

  bool in_space_, irregular_;
  bool priced_;  // single equations are given up instead of spreading what is left of them
  bool tied_;
  /// Corners may have no solution: finding out takes few digits, where many are dear.
  bool cautious_;
  bool drops_first_;  // what must vanish
  bool moments_;
  double tolerance_;
  CalibrationObserver on_search_;
  int searches_ = 0;
  double operations_ = 0.0;  // left for searches
  bool energies_;            // equations of the energies of dilatation take part
  bool soft_moments_ = false;
  double hopeless_ = std::numeric_limits<double>::infinity();  // force that ends a search
  CalibrationEquations equations_;
  CalibrationEquations::State settled_;  // where the exact forces began
  std::vector<double> multipliers_;      // where the last search for them ended
  std::vector<double> start_;            // where the next one starts; empty: zero
  CalibrationReport report_;
  KeptPreconditioner kept_;  // for the force equations
};

}  // namespace perilink
