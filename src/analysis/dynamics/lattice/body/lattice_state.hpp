#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "analysis/dynamics/lattice/body/lattice_body.hpp"
#include "analysis/dynamics/lattice/body/row_places.hpp"
#include "material/j2_plasticity.hpp"

namespace perilink {

/// Threshold of particles that cannot change: larger than any stress, strain or path. It is finite
/// because fast loops do not support infinity.
inline constexpr double never = 1e200;

/// Sums over a row of particles. Sums within rows come first and then the sum over rows, so that no
/// sum depends on the number of threads. The first four are of the last recorded step; work and
/// loss are sums since the beginning.
struct RowSums {
  double stored = 0.0;  ///< between the last step and this (half_step_energy) [force length]
  double kinetic = 0.0;
  Index cracked = 0, yielded = 0;  ///< particles
  double external_work = 0.0;      ///< work of the prescribed motions
  double internal_damping = 0.0;
  double external_damping = 0.0;
  double fractured = 0.0;  ///< stored energy lost by damage at fixed displacements
  double plastic = 0.0;    ///< stored energy lost by flow at fixed displacements

  template <class Archive>
  void serialize(Archive& archive) {
    archive(stored, kinetic, cracked, yielded, external_work, internal_damping, external_damping,
            fractured, plastic);
  }
};

/// Force on the prescribed particles of a row in one step.
struct RowReactions {
  double driven = 0.0;    ///< sum of reaction times amplitude [force length]
  double supports = 0.0;  ///< sum over supports along the load [force]
};

/// Work of a row beyond the elastic work. Bits of ExplicitState::bond_changes change with its bonds
/// only. Bits of ExplicitState::row_changes change while its own particles are checked.
struct BondChanges {
  static constexpr std::uint8_t altered = 1;   ///< own bonds or sums have factors or plastic parts
  static constexpr std::uint8_t weakened = 2;  ///< own bonds have factors
};
struct RowChanges {
  static constexpr std::uint8_t damage_grew = 1, flowed = 2;  ///< of its particles, in this step
  static constexpr std::uint8_t cracked = 4;                  ///< particles have damage
  static constexpr std::uint8_t scanned = 8;  ///< its particles were checked in this step
};

/// Plastic stretches of particles and of bonds; empty where the material cannot yield. The elastic
/// stretch of a bond is its stretch less `mean`. The elastic stretch of each half differs from it
/// by `half`, added for the owner, subtracted for the partner.
struct LatticeFlow {
  std::vector<double> stretch;  ///< plastic, per own half of a particle, shape (2 own bonds, slots)
  std::vector<double> mean;     ///< mean of the two halves of own bonds, shape (own bonds, slots)
  std::vector<double> half;     ///< (partner's - owner's) / 2, same shape
  std::vector<double> sum;      ///< contribution of `half` to the sum of stretches of a particle
  std::vector<double> change;   ///< per row: largest change of a plastic stretch in a step
  std::vector<double> locked;   ///< per row: energy of `half` in its own bonds [force length]
  std::vector<double> yield;    ///< present yield stress of particles [force/length^2]
  std::vector<double> look_at;  ///< von Mises stress at which a particle is checked
  std::vector<double> normal;   ///< Young's modulus times plastic strain out of the plane
  /// Plastic, as a SymmetricTensor, shape (6, slots); consistent rules.
  std::vector<double> strain;
  std::vector<double> equivalent;     ///< plastic strain of particles; consistent rules
  std::vector<std::uint8_t> crushed;  ///< particles that also carry no compression

  template <class Archive>
  void serialize(Archive& archive) {
    archive(stretch, mean, half, sum, change, locked, yield, look_at, normal, strain, equivalent,
            crushed);
  }
};

/// Values that every step computes anew from the displacements. Shapes have the slots of `places`.
struct StepNumbers {
  RowPlaces places;
  /// elastic, of own bonds, shape (own bonds, slots); only where particles can be damaged or yield
  std::vector<double> stretch;
  std::vector<double> effective;  ///< stretch times factor of the bond's damage, same shape
  /// stretch times weight in the owner's sum, same shape; of weakened rows where weights differ
  /// from the factor
  std::vector<double> owners;
  std::vector<double> partners;  ///< stretch times weight in the partner's sum, same shape
  std::vector<double> force;     ///< present directions of own bonds until bond_forces, then the
                                 ///< forces on the owner [force], (own bonds, dim, slots)
  std::vector<double> sum;       ///< weighted stretches summed over all bonds, times length

  /// Writes zeros beyond the end of a row, where absent bonds lead: a longer row at this position
  /// may have left its values.
  void clear_stale(Index row, Index size);
};
StepNumbers make_step_numbers(const ExplicitModel& model, RowPlaces places);

/// State of an explicit lattice run between two steps that set-up cannot rebuild; plain data.
struct LatticeState {
  Index step = 0;                    ///< present step
  std::vector<double> displacement;  ///< at step n [length], shape (dim, slots)
  std::vector<double> velocity;      ///< half a step earlier [length/time], shape (dim, slots)
  std::vector<double> rate;          ///< velocity of the ends along the bond, (own bonds, slots)
  std::vector<double> drag;          ///< damping force of own bonds of weakened rows [force]
  std::vector<double> damage;        ///< tensile, of particles
  std::vector<Index> cracked_in;     ///< step in which damage of a particle began
  std::vector<double> crack_band;    ///< width [length]; zero without a crack
  std::vector<double> crack_at;      ///< first principal stress at which a particle is checked
  std::vector<double>
      quiet_until;  ///< path of the row up to which a crack cannot begin at a particle
  LatticeFlow flow;
  std::vector<RowSums> sums;    ///< per row
  std::vector<double> holding;  ///< force on prescribed components in the last step, zero
                                ///< elsewhere, shape (dim, slots) [force]
  std::vector<double> slack;    ///< per row: change of stretches up to which no particle changes
  std::vector<double> path;     ///< per row: sum of all changes of stretches near it
  std::vector<std::uint8_t> bond_changes;  ///< per row, see BondChanges
  std::vector<std::uint8_t> row_changes;   ///< per row, see RowChanges

  template <class Archive>
  void serialize(Archive& archive) {
    archive(step, displacement, velocity, rate, drag, damage, cracked_in, crack_band, crack_at,
            quiet_until, flow, sums, holding, slack, path, bond_changes, row_changes);
  }
};

/// State of an explicit lattice run with values that follow from LatticeState.
struct ExplicitState : LatticeState {
  explicit ExplicitState(const ExplicitModel& model);

  StepNumbers now;                     ///< complete when observers are called
  std::vector<double> in_tension;      ///< factor of own bonds that stretch, (own bonds, slots)
  std::vector<double> in_compression;  ///< factor of own bonds that shorten
  /// square root of the damage factor of a particle's halves that stretch; one unless the rules are
  /// LatticeRules::consistent
  std::vector<double> root_tension;
  /// square root of the damage factor of a particle's halves that shorten
  std::vector<double> root_compression;
  /// stretch of the owner's half of a stretched own bond over the stretch of the bond; the
  /// partner's is two minus this
  std::vector<double> share_tension;
  /// stretch of the owner's half of a shortened own bond over the stretch of the bond
  std::vector<double> share_compression;
  std::vector<double> next_damage;  ///< at the end of the step
  std::vector<RowReactions> reactions;
  std::vector<double> fastest;  ///< per row: largest change of an elastic stretch in a step
  std::vector<std::uint8_t> near_changes;  ///< damage or flow in the row or next to it
};

}  // namespace perilink
