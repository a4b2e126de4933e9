#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "analysis/dynamics/lattice/body/lattice_body.hpp"
#include "analysis/dynamics/lattice/body/row_places.hpp"
#include "analysis/dynamics/time_state.hpp"
#include "material/j2_plasticity.hpp"

namespace perilink {

/// Threshold of particles that cannot change: larger than any stress, strain or path. It is finite
/// because fast loops do not support infinity.
inline constexpr double never = 1e200;

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
