#pragma once

#include "analysis/dynamics/lattice/body/lattice_particles.hpp"

namespace perilink {

/// Plastic flow of the particles of a lattice. The rules of 2017 and 2018 are kept for comparison
/// with the papers: what they take from a body is no energy that flow dissipates.
class LatticeYielding {
 public:
  LatticeYielding(const ExplicitModel& model, const LatticeParticles& particles)
      : model_(model), particles_(particles) {}

  /// What flow did to a particle.
  struct Change {
    bool flowed = false;   ///< its plastic stretches changed
    bool crushed = false;  ///< it lost its strength in compression (rules of 2017)
    double largest = 0.0;  ///< change of its plastic stretches; consistent rules
  };

  /// Lets a particle flow whose von Mises stress is above the yield stress. Consistent rules:
  /// backward Euler with the associated flow; those of 2017: one step along the deviator of the
  /// force states (Eqs. 3.44–3.48); those of 2018: one along the deviator of the bond forces
  /// (Eqs. 26–30), with a yield stress that hardens with the plastic strain and falls by a factor
  /// in every step beyond the ultimate one (Eq. 24).
  Change flow(ExplicitState& state, Index row, Index slot) const;

  /// Equivalent plastic strain of a particle: the sum of sqrt(2/3 de : de); by the rules of 2018
  /// and 2017 that of the plastic stretches that it has (2018, Eq. 25).
  double plastic_strain(const ExplicitState& state, Index row, Index slot) const;

 private:
  using Neighbourhood = LatticeParticles::Neighbourhood;
  using Halves = LatticeParticles::Halves;

  Change flow_consistently(ExplicitState& state, const Neighbourhood& neighbourhood) const;
  Change flow_as_in_2017(ExplicitState& state, const Neighbourhood& neighbourhood) const;
  Change flow_as_in_2018(ExplicitState& state, const Neighbourhood& neighbourhood) const;
  /// Present yield stress by the rules of 2017, and whether the particle is beyond its ultimate
  /// strain.
  double yield_of_2017(const ExplicitState& state, const Neighbourhood& neighbourhood,
                       bool& beyond) const;
  /// Yield stress of the next step by the rules of 2018, and when to look at the particle again.
  void harden_as_in_2018(ExplicitState& state, const Neighbourhood& neighbourhood) const;
  /// That of the plastic stretches that a particle has.
  double present_plastic_strain(const ExplicitState& state,
                                const Neighbourhood& neighbourhood) const;
  /// Adds the deviator of forces to the plastic stretches, scaled to a length.
  /// \returns false for equal forces, by which the rules of the papers do not flow
  bool step_along(const Halves& force, double length, ExplicitState& state,
                  const Neighbourhood& neighbourhood) const;

  const ExplicitModel& model_;
  const LatticeParticles& particles_;
};

}  // namespace perilink
