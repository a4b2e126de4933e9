#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "analysis/dynamics/explicit_run.hpp"

/// \file
/// State of a run over time between two steps: everything that set-up cannot rebuild. Plain data
/// with functions serialize() for archives of the library cereal.

namespace perilink {

/// State of ExplicitLoop.
struct LoopState {
  Index step = 0;                                               ///< next step
  double initial = 0.0, supplied = 0.0, largest_surplus = 0.0;  ///< energies [force length]
  ExplicitResult result;                                        ///< so far

  template <class Archive>
  void serialize(Archive& archive) {
    archive(step, initial, supplied, largest_surplus, result);
  }
};

/// State of the elements of an explicit run (ExplicitBonds); arrays of other kinds of elements are
/// empty.
struct MovingElements {
  std::vector<std::uint8_t> intact;  ///< bonds on the stencil, one bit per slot
  /// Directed bonds stored one by one that have left their first segment, ascending.
  std::vector<std::uint64_t> changed;
  std::vector<int> segment;           ///< of the changed bonds
  std::vector<double> stiffness;      ///< of the changed bonds, shape (changed, moduli of a bond)
  std::vector<int> slip_segment;      ///< of embedded slip springs, per end particle
  std::vector<double> damage;         ///< of state-based particles, for the next step
  std::vector<double> last_damage;    ///< of state-based particles, in the last step
  std::vector<std::uint8_t> cracked;  ///< state-based particles in which a crack has begun

  template <class Archive>
  void serialize(Archive& archive) {
    archive(intact, changed, segment, stiffness, slip_segment, damage, last_damage, cracked);
  }
};

/// State of a network of bonds in motion (MovingBonds).
struct BondsState {
  std::vector<double> displacement, velocity;  ///< shape (particles, width)
  /// Energies since the beginning, per block of particles [force length].
  std::vector<double> fractured, external_work, damping_work;
  std::vector<Index> broken;  ///< order of breaking
  MovingElements elements;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(displacement, velocity, fractured, external_work, damping_work, broken, elements);
  }
};

/// State of a dynamic relaxation between two load steps, beside that of its bonds.
struct RelaxationState {
  std::uint64_t load_step = 0;  ///< next load step, from zero
  Index iterations = 0;         ///< over all load steps
  double load_factor = 0.0;     ///< of the last load step
  double peak_load = 0.0;       ///< largest support reaction in magnitude [force]
  double fractured = 0.0;       ///< energy of broken bonds [force length]
  double largest_residual = 0.0, largest_error = 0.0;
  double square = 0.0;         ///< square of the damped frequency [1/time^2]
  double most_held = 0.0;      ///< square of the largest loads and reactions [force^2]
  double examined = -1.0;      ///< `fractured` when pieces were last examined [force length]
  bool is_unstrained = false;  ///< prescribed displacements strain no piece

  template <class Archive>
  void serialize(Archive& archive) {
    archive(load_step, iterations, load_factor, peak_load, fractured, largest_residual,
            largest_error, square, most_held, examined, is_unstrained);
  }
};

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

/// State of a run over time. A run of explicit bonds has `loop` and `bonds`, a dynamic relaxation
/// `bonds` and `relaxation`, a lattice `loop` and `lattice`; the other members are empty.
struct TimeState {
  ExplicitRecord record;  ///< the last row, with the loads of the last step
  LoopState loop;
  BondsState bonds;
  RelaxationState relaxation;
  LatticeState lattice;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(record, loop, bonds, relaxation, lattice);
  }
};

/// Refuses the state of another body.
/// \throws std::invalid_argument where the numbers of saved and of own values differ
inline void expect_equal_sizes(std::size_t saved, std::size_t own) {
  if (saved == own) return;
  throw std::invalid_argument("the saved state is that of another body: it has " +
                              std::to_string(saved) + " values instead of " + std::to_string(own));
}

}  // namespace perilink
