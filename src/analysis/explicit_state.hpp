#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "analysis/explicit_model.hpp"

namespace perilink {

/// Sums over a row of particles. Rows are summed in their own order and then one after the other,
/// so that no sum depends on the number of threads. Work and loss are sums since the beginning.
struct RowSums {
  double stored = 0.0;         ///< energy of the bonds and of the sums of stretches [force length]
  double stored_before = 0.0;  ///< the same in the last step
  double external_work = 0.0;  ///< of the prescribed motions
  double internal_damping = 0.0;
  double external_damping = 0.0;
  double fractured = 0.0;  ///< stored energy lost while damage grew at rest
};

/// Force on the prescribed particles of a row in one step.
struct RowReactions {
  double driven = 0.0;    ///< sum of reaction times amplitude [force length]
  double supports = 0.0;  ///< of supports along the load [force]
};

/// Everything of an explicit lattice run that changes with time: displacements at step n,
/// velocities half a step earlier.
struct ExplicitState {
  explicit ExplicitState(const ExplicitModel& model);

  std::vector<double> displacement;  ///< [length], shape (dim, slots)
  std::vector<double> velocity;      ///< [length/time], shape (dim, slots)
  std::vector<double> stretch;       ///< of own bonds, shape (own bonds, slots)
  std::vector<double> effective;     ///< stretch times factor of the bond's damage, same shape
  std::vector<double> direction;     ///< present, of own bonds, shape (own bonds, dim, slots)
  std::vector<double> rate;          ///< velocity of the ends along the bond, (own bonds, slots)
  std::vector<double> drag;          ///< damping force of own bonds [force], (own bonds, slots)
  std::vector<double> force;         ///< on the owner [force], shape (own bonds, dim, slots)
  std::vector<double> sum;           ///< of effective stretches over all bonds, weighted by length
  std::vector<double> in_tension;    ///< factor of own bonds that stretch, (own bonds, slots)
  std::vector<double> in_compression;  ///< factor of own bonds that shorten
  std::vector<double> damage;          ///< tensile, of particles
  std::vector<double> next_damage;     ///< at the end of the step
  std::vector<double> crack_band;      ///< width [length]; zero where no crack began
  std::vector<RowSums> sums;           ///< of each row
  std::vector<RowReactions> reactions;
  std::vector<double> tension_bound;  ///< of each row: no principal stress is larger
  std::vector<std::uint8_t> cracked;  ///< rows with damage
  std::vector<std::uint8_t> changed;  ///< rows whose damage grew in this step
  std::vector<std::uint8_t> touched;  ///< rows whose sums of stretches that changes
};

}  // namespace perilink
