#pragma once

#include <array>
#include <vector>

#include "analysis/explicit_state.hpp"

namespace perilink {

/// Symmetric tensor in the plane.
struct PlaneTensor {
  double xx = 0.0, yy = 0.0, xy = 0.0;
};

/// Its eigenvalues, the larger first, and the direction of the first.
struct PrincipalValues {
  double first = 0.0, second = 0.0;
  Vector3 direction{};
};
PrincipalValues principal_values(const PlaneTensor& tensor);

/// Damage of the particles of a hexagonal lattice.
class LatticeDamage {
 public:
  explicit LatticeDamage(const ExplicitModel& model);

  /// Grows the damage of the rows that are near the strength or have cracks, with the state's
  /// stretches; then brings factors, effective stretches, sums and stored energies up to date.
  /// Called by every thread of a parallel region.
  void grow(ExplicitState& state, double time_step) const;

  /// Stress of a particle: (1 / 2V) sum_j L n n' F_j over its bonds [force/length^2].
  PlaneTensor stress(const ExplicitState& state, Index row, Index slot) const;

 private:
  /// The six bonds of a particle, own ones first, then the incoming ones.
  struct Family {
    std::array<Index, 6> bond{};     ///< slot of the owner
    std::array<Index, 6> partner{};  ///< slot of the other particle
    unsigned mask = 0;               ///< bit j: bond j exists
  };
  Family family(Index row, Index slot) const;
  /// Strain that fits the stretches of the existing bonds best.
  PlaneTensor fit(const std::array<double, 6>& stretch, unsigned mask) const;
  /// Stretches of the particle's own halves of its bonds.
  std::array<double, 6> half_stretches(const ExplicitState& state, const Family& family,
                                       Index slot) const;
  bool begins(const ExplicitState& state, Index row, Index slot, const Family& family,
              PrincipalValues& principal) const;
  double damage_of(const ExplicitState& state, Index slot, const Family& family) const;
  void grow_row(ExplicitState& state, Index row) const;
  /// Stored energy of a row with the stretches of this step times those of the last one. The
  /// integrator moves through each force for half a step on either side, so that this is what its
  /// motion loses where factors fall: exact for a linear body.
  double half_step_energy(const ExplicitState& state, Index row, double time_step) const;
  void mark_touched(ExplicitState& state) const;
  void update_factors(ExplicitState& state, Index row) const;

  const ExplicitModel& model_;
  /// Least-squares inverse of "stretch of bond j from strain" for every set of existing bonds.
  std::array<std::array<double, 18>, 64> inverse_{};
};

}  // namespace perilink
