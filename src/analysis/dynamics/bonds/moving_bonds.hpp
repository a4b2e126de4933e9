#pragma once

#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "analysis/dynamics/bonds/break_order.hpp"
#include "analysis/dynamics/bonds/explicit_bonds.hpp"
#include "analysis/dynamics/bonds/free_motion.hpp"
#include "analysis/dynamics/explicit_run.hpp"
#include "analysis/dynamics/inertia.hpp"
#include "analysis/dynamics/time_state.hpp"
#include "analysis/ranks/particle_blocks.hpp"
#include "network/loaded_network.hpp"

namespace perilink {

/// State passed to observers of a run of explicit bonds, valid during the call only.
struct BondRunState {
  const Network& network;
  const BondMotion& motion;
  const ExplicitBonds& bonds;
  /// Bonds that broke, or state-based particles that cracked; ordered by step, then by number.
  const std::vector<Index>& broken;
  /// Finds the forces on supports and displacement-controlled particles, inertia included, zero
  /// elsewhere; shape (particles, width) [force].
  std::function<std::vector<double>()> reactions = {};
};

using BondRunObserver = RunObserver<BondRunState>;

/// Sums over the particles of a block, or of all blocks.
struct MotionSums {
  double fractured = 0.0;  ///< since the beginning, like `work` [force length]
  MotionWork work;
  double stored = 0.0, kinetic = 0.0;  ///< filled where a run measures energies [force length]
  double loaded = 0.0;                 ///< reference forces times displacements [force length]
  double driven = 0.0;    ///< reactions times prescribed motions in the last step [force length]
  double supports = 0.0;  ///< reactions of supports along the load [force]
};

/// Returns the component with the largest prescribed motion or load.
int main_component(const LoadedNetwork& problem);

/// Network of bonds in motion, common to explicit runs and dynamic relaxation. Blocks of particles
/// may be computed in parallel; each stage ends for all blocks before the next begins.
struct MovingBonds {
  /// Starts with zero motion and all bonds intact.
  /// \param problem  must outlive this object
  /// \param masses   must outlive this object
  MovingBonds(const LoadedNetwork& problem, const Inertia& masses,
              std::unique_ptr<ExplicitBonds> elements, double step_length);

  /// Sums over neighbours; called before find_forces() where the bonds have states.
  void prepare(Index block, Index step);
  /// Finds internal forces, including elastic supports, and breaks bonds that reach their limit.
  void find_forces(Index block, Index step);
  /// Returns half of u_(n-1)' K u_n of the particles [begin, end) [force length].
  double stored(Index begin, Index end) const;
  bool is_held(std::size_t slot) const { return unknowns.number[slot] == no_index; }
  /// Returns the force on a prescribed component whose velocity becomes `faster` [force].
  double holding_force(std::size_t slot, double load_factor, double faster, double damping) const {
    const double v = motion.velocity[slot], m = mass[slot];
    return m * (faster - v) / time_step + 0.5 * damping * m * (v + faster) + force[slot] -
           load_factor * loads[slot];
  }
  /// Returns BondRunState::reactions.
  /// \param increment  fraction of the prescribed displacements added in this step
  std::vector<double> reactions(double load_factor, double increment, double damping) const;
  /// Adds the force on a prescribed component to its sum [force].
  void add_reaction(std::size_t slot, double reaction, MotionSums& to) const;
  MotionSums total() const;

  /// Records the force on displacement-controlled particles, or the applied load, and the reactions
  /// of supports.
  void note_reactions(const MotionSums& all, double load_factor, ExplicitRecord& record) const;
  /// Records the displacement of controlled or loaded particles and the number of broken bonds.
  /// \param motion_factor  fraction of the prescribed displacements reached
  void note_motion(const MotionSums& all, double motion_factor, ExplicitRecord& record);
  /// Returns the state for observers. Called by one thread between two steps.
  BondRunState state(std::function<std::vector<double>()> reactions_now = {}) {
    return {network, motion, *bonds, broken.so_far(), std::move(reactions_now)};
  }
  /// Saves motion, energies, breaks and elements. Called by one thread between two steps.
  void save(BondsState& state);
  /// Continues from a saved state, in an object just constructed.
  /// \throws std::invalid_argument where the state is that of another body
  void restore(const BondsState& state);

  const Network& network;
  const Unknowns& unknowns;
  const std::vector<double>& loads;  ///< at load factor 1
  const ReferenceLoad& reference;
  const std::vector<double>& mass;
  std::unique_ptr<ExplicitBonds> bonds;
  double time_step;
  int component;  ///< component in which the reaction of supports is summed
  ParticleBlocks blocks;
  BreakOrder broken;
  BondMotion motion;
  std::vector<double> force;     ///< internal, shape (particles, width)
  std::vector<MotionSums> sums;  ///< per block

 private:
  void lose(Index block, Index step, const BondLosses& losses);
};

}  // namespace perilink
