#pragma once

#include "analysis/dynamics/lattice/body/lattice_particles.hpp"

namespace perilink {

/// Damage of the particles of a lattice: where it begins, how far it has to have grown, and what it
/// does to their bonds.
class LatticeDamage {
 public:
  LatticeDamage(const ExplicitModel& model, const LatticeParticles& particles)
      : model_(model), particles_(particles) {}

  /// Lets the damage of a particle begin or grow with the present stretches: notes next_damage and
  /// the thresholds at which the particle has to be looked at again.
  /// \returns whether its damage is larger than before
  bool grow(ExplicitState& state, Index row, Index slot) const;

  /// What the damages of a row's particles leave of their halves in the sums.
  void update_roots(ExplicitState& state, Index row) const;
  /// Factors and shares of the own bonds of a row, from the damages of their particles.
  void update_factors(ExplicitState& state, Index row) const;

 private:
  using Neighbourhood = LatticeParticles::Neighbourhood;

  /// Whether a crack begins; sets how long the particle can wait where it does not.
  /// \param normal  becomes the direction of the first principal stress
  bool begins(ExplicitState& state, Index row, const Neighbourhood& neighbourhood,
              Vector3& normal) const;
  /// Strain that drives the damage. Consistent: the first principal stress over what damage leaves
  /// of Young's modulus; at faces that which the particle would carry undamaged, from the strain of
  /// its halves. 2017: the first principal strain; 2018: Eq. 38.
  double driving_strain(const ExplicitState& state, const Neighbourhood& neighbourhood) const;
  /// Whether damage follows the particle's own stress: by the consistent rules away from faces.
  bool follows_stress(const Neighbourhood& neighbourhood) const;
  /// Sets the threshold at which a cracked particle has to be looked at again by the consistent
  /// rules.
  void watch(ExplicitState& state, const Neighbourhood& neighbourhood, double strain,
             double damage) const;
  double damage_at(double strain, double band) const;

  const ExplicitModel& model_;
  const LatticeParticles& particles_;
};

}  // namespace perilink
