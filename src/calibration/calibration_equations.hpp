#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "calibration/balance_measure.hpp"
#include "calibration/bond_equations.hpp"
#include "calibration/bond_orbits.hpp"
#include "calibration/bounded_least_squares/equations/point_equations.hpp"
#include "calibration/calibration_input.hpp"
#include "discretization/facets.hpp"

namespace perilink {

/// State of a calibration, its variables, and the equations of the next step. Variables are the
/// axial stiffness of the free bonds and, for micropolar bonds, the couples at both ends. Where all
/// bonds are free, nodal area fractions are variables too.
class CalibrationEquations {
 public:
  /// \param least_weight  lower bound of the axial stiffness, relative to the start
  /// \param stiffness     start of the calibration
  /// \param orbits  symmetry-equivalent bonds, which have equal weights; only the representatives
  ///     have equations. Null: all particles have equations
  CalibrationEquations(const CalibrationInput& input, double least_weight, const Facets& facets,
                       const BondStiffness& stiffness, const BondOrbits* orbits = nullptr);

  /// Returns exact equations of forces and moments at every particle in every uniform strain
  /// (moments until soften_moments()).
  PointEquations balance() const { return make_equations(forces_); }
  /// Returns equations of forces and moments, with soft equations for the energies of dilatation of
  /// interior particles and of columns under the surface.
  PointEquations settling() const;
  /// Makes the equations of moments soft; forces stay exact.
  void soften_moments() { moments_ridge_ = soft_ridge; }
  /// Sets the state to a solution of these equations.
  void apply(std::span<const double> weights);

  /// Writes unbalanced forces and moments to the report (balance_measure.hpp).
  void report_balance(CalibrationReport& report) const;
  /// Writes the weights of the free bonds to the report.
  void report_weights(CalibrationReport& report) const;

  /// Removes the lower bound of bonds at particles whose unbalanced force exceeds the limit.
  /// \return whether a lower bound was removed
  bool allow_zero(double limit);
  /// Drops bonds that have fallen to zero: no finite multiplier makes a weight exactly zero.
  /// \return fraction of the free bonds that are dropped
  double drop_zero_weights();
  /// Presolve from the start: drops the bonds of an equation whose right side is zero and to which
  /// no bond can contribute with the other sign. At the corner of a cube these are all bonds that
  /// point inwards from its faces. \return whether bonds were dropped
  bool drop_fixed_at_zero();
  Index num_points() const { return static_cast<Index>(particle_of_.size()); }
  Index num_dropped() const { return static_cast<Index>(free_bonds_.size() - kept_.size()); }
  /// Whether a particle has lost more than half of its bonds.
  bool underconstrained() const;

  /// Stiffnesses and nodal area fractions, to save and restore.
  struct State {
    BondStiffness stiffness;
    std::vector<double> shares;
  };
  State save() const { return {stiffness_, facets_.shares}; }
  void restore(State state) {
    stiffness_ = std::move(state.stiffness);
    facets_.shares = std::move(state.shares);
  }
  void start_over() { restore(start_); }  ///< without dropped bonds
  /// Returns the state with zero stiffness of dropped bonds.
  State without_dropped(State state) const;
  void take_all_back();  ///< restores all bonds and lower bounds

 private:
  /// Bonds without lower bound count as falling to zero below this weight.
  static constexpr double vanishing = 1e-3;
  enum class Kind { axial, couple, share };
  /// Lower bound of the axial stiffness; small: for bonds that remain after others fell to zero.
  enum class Floor : std::uint8_t { least_weight, none, small };

  /// A quantity in the equations: its value is present + scale (weight - 1).
  struct Variable {
    Kind kind;
    Index index;          // bond or facet
    Index end;            // 0 or 1: end where the couple acts; or corner that gives area
    Index first, second;  // particles; first is the one at that end or corner
    double present, scale, least, most;
  };
  template <class Visit>
  void for_each_variable(Visit visit) const;
  template <class Visit>
  void for_each_share(Visit visit) const;
  Index class_of(Index bond) const { return orbits_ ? orbits_->of_bond(bond) : bond; }
  template <class Gone>
  void drop(Gone gone);
  Variable axial_variable(Index bond) const;
  Variable couple_variable(Index bond, Index end) const;
  void change(const Variable& variable, double value);
  void fill_row(const ForceRows& form, const Variable& variable, double* row) const;
  PointEquations make_equations(const ForceRows& form) const;
  void set_right_sides(PointEquations& equations) const;
  std::vector<double> out_of_balance() const;
  void choose_points();

  /// The inverse of this weights squares of soft moments against squares of the changes.
  static constexpr double soft_ridge = 1e-4;

  const CalibrationInput& input_;
  const BondOrbits* orbits_;
  double least_weight_;
  int dim_;
  ForceRows forces_;
  BondStiffness stiffness_;               // at present
  Facets facets_;                         // with the present area fractions
  State start_;                           // zero for dropped bonds
  const State given_;                     // all of them
  std::vector<Index> point_of_;           // per particle, no_index where no free bond ends
  std::vector<Index> particle_of_;        // per point
  double moments_ridge_ = 0.0;            // 0: exact
  std::vector<Index> free_bonds_;         // in the order of the equations
  std::vector<Index> kept_;               // the free bonds that were not dropped
  std::vector<Floor> floor_;              // per bond
  std::vector<std::uint8_t> on_surface_;  // per particle: at a facet
  ParticleScales scales_;                 // at the start
};

}  // namespace perilink
