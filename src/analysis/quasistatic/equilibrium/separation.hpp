#pragma once

#include <span>
#include <utility>
#include <vector>

#include "analysis/quasistatic/equilibrium/displacement/solution.hpp"
#include "analysis/quasistatic/equilibrium/reaction_work.hpp"

namespace perilink {

/// Pivots below this are recomputed from energies. The condition number of a slender or nearly
/// separated body takes most digits of the factor's pivots.
inline constexpr double uncertain_pivot = 1e-2;

/// Detects whether a removal separates the body. Finds equilibrium if motions are so large that
/// double precision leaves few digits of the strains (docs/theory/events_and_energy.md, section 5).
/// Both use energies of the elements in extended precision.
class SeparationCheck {
 public:
  SeparationCheck(DamagedBody& body, Solution& solution, const ReactionWork& work);

  /// Returns whether pivots that are not small may be noise too.
  bool doubts_pivots() const { return doubts_pivots_; }
  void doubt_pivots() { doubts_pivots_ = true; }

  /// Sets the pivots of a removal; zero if a vector has no resistance. Small pivots come from
  /// energies. K^-1 is then reliable, or the removal needs a new one.
  /// \param kept  secant that stays
  void measure_pivots(Removal& removal, Index element, double kept);
  /// Returns the resistance to a motion of an element's ends without the element, a pivot. The
  /// element is open afterwards.
  /// \param kept  secant that stays
  /// \return pivot; 0 if it cannot be distinguished from zero. Whether only elastic supports resist
  std::pair<double, bool> resistance(const SparseVector& x, Index element, double kept);
  /// Returns whether a loose part is held only by elastic supports that are negligible compared
  /// with its former support.
  /// \param growth  of the compliance by the removal
  bool hangs_on_weak_supports(const Removal& removal, double growth) const;
  /// Finds equilibrium from a new K^-1 without the element, or with a smaller secant.
  /// \return false if the matrix is not positive definite; then all is unchanged
  bool rebuild_without(Index element, double kept);

  /// Refined equilibrium.
  struct Refinement {
    Balance balance;
    /// Relative error of a solve by K^-1, in the energy norm.
    double inverse_error = 0.0;
    bool resists = true;       ///< the body stores energy above round-off
    bool on_supports = false;  ///< elastic supports hold most of the motion
  };
  /// Refines the displacements in extended precision and stores them rounded. Pivots may then be
  /// noise too.
  Refinement refine();
  /// Refines the displacements by permanent loads.
  void refine_permanent();
  /// Computes the work of a body whose reactions nearly cancel from the energy of its elements, a
  /// sum of squares.
  LoadWork work_by_energy();

 private:
  struct Refined {
    double residual = 0.0;  ///< norm of the residual forces
    double energy = 0.0;    ///< u'K u of the refined motion
    double error = 0.0;     ///< uncertainty of the energy after the last correction, with round-off
    /// Relative error of a solve by K^-1, in the energy norm.
    double inverse_error = 0.0;
    double least_error = 0.0;  ///< part of the error by the round-off of rigid motions
  };
  /// Motion in extended precision: the unknowns, and all particles, shape (particles, width).
  struct FineMotion {
    std::vector<long double> unknowns, particles;
    explicit FineMotion(const Field& field)
        : unknowns(field.values.begin(), field.values.end()),
          particles(field.displacement.begin(), field.displacement.end()) {}
    FineMotion(std::size_t num_unknowns, std::size_t num_slots)
        : unknowns(num_unknowns, 0.0L), particles(num_slots, 0.0L) {}
    std::vector<double> rounded() const { return {unknowns.begin(), unknowns.end()}; }
    long double along(const SparseVector& x) const;
  };
  Refined refine_finely(std::span<const double> load, FineMotion& motion);
  std::pair<FineMotion, double> motion_of(const SparseVector& x);
  double decouple_by_inverse(Removal& removal);
  std::vector<double> refined_compliance(const Removal& removal);
  void look_closely(Removal& removal, Index element, double kept);

  DamagedBody& body_;
  Solution& solution_;
  const ReactionWork& work_;
  ForcesAndEnergy<long double> fine_;
  double stiffness_sum_ = 0.0;  ///< sum over all elements and supports
  bool doubts_pivots_ = false;
};

}  // namespace perilink
