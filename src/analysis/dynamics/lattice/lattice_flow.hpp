#pragma once

#include "analysis/dynamics/lattice/body/lattice_particles.hpp"

namespace perilink {

/// Plastic flow of the particles of a lattice.
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
  /// force states (Eqs. 3.44–3.48). For those of 2018 see flow_row_as_printed.
  Change flow(ExplicitState& state, Index row, Index slot) const;

  /// Equivalent plastic strain of a particle: the sum of sqrt(2/3 de : de); by the rules of 2018
  /// and 2017 that of the plastic stretches that it has (2018, Eq. 25).
  double plastic_strain(const ExplicitState& state, Index row, Index slot) const;

 private:
  using Family = LatticeParticles::Family;
  using Halves = LatticeParticles::Halves;

  Change flow_consistently(ExplicitState& state, const Family& family) const;
  Change flow_as_printed(ExplicitState& state, const Family& family) const;
  /// Present yield stress by the rules of 2017, and whether the particle is beyond its ultimate
  /// strain.
  double printed_yield(const ExplicitState& state, const Family& family, bool& beyond) const;

  const ExplicitModel& model_;
  const LatticeParticles& particles_;
};

}  // namespace perilink
