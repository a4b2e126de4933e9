#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "analysis/dynamics/explicit_run.hpp"
#include "analysis/dynamics/lattice/body/lattice_state.hpp"

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
