#pragma once

#include "analysis/dynamics/lattice/body/lattice_particles.hpp"

namespace perilink {

/// Plastic flow of the particles of a lattice. The rules of 2017 and 2018 are not conservative and
/// are kept for comparison with the papers.
class LatticeYielding {
 public:
  LatticeYielding(const ExplicitModel& model, const LatticeParticles& particles)
      : model_(model), particles_(particles) {}

  /// Effect of flow on a particle.
  struct Change {
    bool flowed = false;   ///< its plastic stretches changed
    bool crushed = false;  ///< it lost its strength in compression (rules of 2017)
    double largest = 0.0;  ///< largest change of its plastic stretches; consistent rules
  };

  /// Applies flow to a particle whose von Mises stress is above the yield stress.
  ///
  /// Consistent rules: backward Euler with the associated flow. Rules of 2017: one step along the
  /// deviator of the force states (Eqs. 3.44–3.48). Rules of 2018: one step along the deviator of
  /// the bond forces (Eqs. 26–30). Their yield stress hardens with the plastic strain and falls by
  /// a factor in every step beyond the ultimate strain (Eq. 24).
  Change flow(ExplicitState& state, Index row, Index slot) const;

  /// Returns the equivalent plastic strain of a particle: the sum of sqrt(2/3 de : de). By the
  /// rules of 2017 and 2018 it is the equivalent of the present plastic stretches (2018, Eq. 25).
  double plastic_strain(const ExplicitState& state, Index row, Index slot) const;

 private:
  using Neighbourhood = LatticeParticles::Neighbourhood;
  using Halves = LatticeParticles::Halves;

  Change flow_consistently(ExplicitState& state, const Neighbourhood& neighbourhood) const;
  Change flow_as_in_2017(ExplicitState& state, const Neighbourhood& neighbourhood) const;
  Change flow_as_in_2018(ExplicitState& state, const Neighbourhood& neighbourhood) const;
  /// Returns the present yield stress by the rules of 2017.
  /// \param beyond  becomes whether the particle is beyond its ultimate strain
  double yield_of_2017(const ExplicitState& state, const Neighbourhood& neighbourhood,
                       bool& beyond) const;
  /// Sets the yield stress of the next step by the rules of 2018, and the threshold of the next
  /// check.
  void harden_as_in_2018(ExplicitState& state, const Neighbourhood& neighbourhood) const;
  /// Returns the equivalent strain of a particle's present plastic stretches.
  double present_plastic_strain(const ExplicitState& state,
                                const Neighbourhood& neighbourhood) const;
  /// Adds the deviator of forces, scaled to a length, to the plastic stretches.
  /// \returns false for equal forces, under which the papers' rules have no flow
  bool step_along(const Halves& force, double length, ExplicitState& state,
                  const Neighbourhood& neighbourhood) const;

  const ExplicitModel& model_;
  const LatticeParticles& particles_;
};

}  // namespace perilink
