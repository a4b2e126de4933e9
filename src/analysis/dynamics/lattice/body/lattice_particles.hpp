#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "analysis/dynamics/lattice/body/lattice_state.hpp"
#include "material/principal_values.hpp"

namespace perilink {

/// Bonds, forces and stresses of single particles of a lattice, for the few particles that change.
class LatticeParticles {
 public:
  static constexpr int most_bonds = 18;
  using Halves = std::array<double, most_bonds>;

  explicit LatticeParticles(const ExplicitModel& model);

  /// Bonds of a particle: own bonds first, then incoming ones. The mask excludes absent bonds.
  struct Neighbourhood {
    Index slot = 0;
    int bonds = 0;                            ///< 6 or 18
    std::array<Index, most_bonds> at{};       ///< in arrays of shape (own bonds, slots)
    std::array<Index, most_bonds> partner{};  ///< slot of the other particle
    Index now = 0;                            ///< slot in StepNumbers
    std::array<Index, most_bonds> now_at{}, now_partner{};  ///< positions in StepNumbers
    std::uint32_t mask = 0;                                 ///< bit j: bond j exists

    bool has(int j) const { return (mask >> j & 1U) != 0U; }
    int own_number(int j) const { return j < bonds / 2 ? j : j - bonds / 2; }
    /// Returns the sign of LatticeFlow::half: plus one for own bonds, minus one for incoming ones.
    double side(int j) const { return j < bonds / 2 ? 1.0 : -1.0; }
  };
  Neighbourhood neighbourhood(const ExplicitState& state, Index row, Index slot) const;
  bool is_whole(const Neighbourhood& neighbourhood) const { return neighbourhood.mask == whole_; }
  /// Returns whether a particle or one of its neighbours lacks bonds.
  bool is_near_face(Index slot) const { return near_face_[slot] != 0; }

  /// Returns elastic stretches of the particle's halves of its bonds, without shares of damage.
  Halves elastic(const ExplicitState& state, const Neighbourhood& neighbourhood) const;
  /// Returns elastic stretches of the particle's halves for damage. In bonds between different
  /// damages each half has its share; the rules of 2017 use whole bonds.
  Halves shared(const ExplicitState& state, const Neighbourhood& neighbourhood) const;
  /// Returns the damage factor of a bond by the sign of its stretch.
  static double factor(const ExplicitState& state, const Neighbourhood& neighbourhood, int bond);
  /// Returns the square root of the damage factor of the particle's half of a bond; one
  /// unless the rules are LatticeRules::consistent.
  static double root(const ExplicitState& state, const Neighbourhood& neighbourhood, int bond);
  /// Returns the force states of the particle [force]: own modulus times stretch times damage
  /// factor, plus its part of the sum times `root`.
  Halves forces(const ExplicitState& state, const Neighbourhood& neighbourhood) const;
  /// Returns the force states of the particles at the other ends, each in the bond to the particle,
  /// by LatticeRules::least_2018 or mean_2017 [force].
  Halves partner_forces(const ExplicitState& state, const Neighbourhood& neighbourhood) const;
  /// Returns (1 / 2V) sum_j L n n' F_j, with the stress out of the plane in plane strain
  /// [force/length^2].
  /// \param force  F_j from forces()
  SymmetricTensor stress(const ExplicitState& state, const Neighbourhood& neighbourhood,
                         const Halves& force) const;
  SymmetricTensor stress(const ExplicitState& state, const Neighbourhood& neighbourhood) const {
    return stress(state, neighbourhood, forces(state, neighbourhood));
  }
  /// Returns the mean of the stresses of a particle and its neighbours, weighted with their
  /// volumes, without plastic strains out of the plane.
  /// \param volume  becomes the sum of the volumes
  /// \param count   becomes the number of particles
  SymmetricTensor mean_stress(const ExplicitState& state, const Neighbourhood& neighbourhood,
                              Index row, double& volume, int& count) const;

  /// Returns the strain that fits the stretches of the existing bonds best; in the plane xx, yy and
  /// xy only.
  SymmetricTensor fit(const Halves& stretch, const Neighbourhood& neighbourhood) const;
  /// Returns the stretches of the bonds under a strain.
  Halves project(const SymmetricTensor& strain, const Neighbourhood& neighbourhood) const;

 private:
  /// Returns a neighbourhood without the slots in StepNumbers.
  Neighbourhood neighbourhood(Index row, Index slot) const;
  /// Least-squares inverse of "stretch of bond j from strain", shape (bonds, 3 or 6).
  using Inverse = std::vector<double>;
  Inverse invert(std::uint32_t mask) const;
  void find_faces();
  /// Returns elastic stretches of the halves at one end, 1: the particle's own, -1: its partners'.
  Halves elastic_at(double end, const ExplicitState& state,
                    const Neighbourhood& neighbourhood) const;
  SymmetricTensor bond_stress(const Neighbourhood& neighbourhood, const Halves& force) const;
  const Inverse& inverse_of(const Neighbourhood& neighbourhood) const {
    return inverses_[kind_[neighbourhood.slot]];
  }

  const ExplicitModel& model_;
  std::uint32_t whole_ = 0;
  std::vector<Inverse> inverses_;
  std::vector<std::uint8_t> near_face_;
  std::vector<std::uint32_t> kind_;  ///< per slot: number of the particle's inverse
};

}  // namespace perilink
