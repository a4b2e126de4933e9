#pragma once

#include "analysis/dynamics/lattice/body/lattice_particles.hpp"

namespace perilink {

/// Damage of the particles of a lattice: onset, growth, and effect on bonds.
class LatticeDamage {
 public:
  LatticeDamage(const ExplicitModel& model, const LatticeParticles& particles)
      : model_(model), particles_(particles) {}

  /// Finds the damage of a particle under the present stretches. Records next_damage and the
  /// thresholds of the particle's next check.
  /// \returns whether its damage is larger than before
  bool grow(ExplicitState& state, Index row, Index slot) const;

  /// Sets the roots of damage factors of the halves of a row's particles in the sums.
  void update_roots(ExplicitState& state, Index row) const;
  /// Sets factors and shares of the own bonds of a row from the damage of their particles.
  void update_factors(ExplicitState& state, Index row) const;

 private:
  using Neighbourhood = LatticeParticles::Neighbourhood;

  /// Returns whether a crack begins. If not, sets the threshold of the next check.
  bool begins(ExplicitState& state, Index row, const Neighbourhood& neighbourhood,
              Vector3& normal) const;
  /// Returns the strain that governs damage. Consistent: first principal stress over the damaged
  /// Young's modulus; near faces, undamaged stress from the strain of the particle's halves over
  /// Young's modulus. 2017: first principal strain. 2018: Eq. 38.
  double driving_strain(const ExplicitState& state, const Neighbourhood& neighbourhood) const;
  /// Returns whether damage follows the particle's own stress: by the consistent rules away from
  /// faces.
  bool follows_stress(const Neighbourhood& neighbourhood) const;
  /// Sets the threshold of the next check of a cracked particle by the consistent rules.
  void watch(ExplicitState& state, const Neighbourhood& neighbourhood, double strain,
             double damage) const;
  double damage_at(double strain, double band) const;

  const ExplicitModel& model_;
  const LatticeParticles& particles_;
};

}  // namespace perilink
