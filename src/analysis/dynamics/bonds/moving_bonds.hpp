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
#include "analysis/ranks/particle_blocks.hpp"
#include "network/loaded_network.hpp"

namespace perilink {

/// What observers of a run of moving bonds may look at, valid during the call only.
struct BondRunState {
  const Network& network;
  const BondMotion& motion;
  const ExplicitBonds& bonds;
  /// Bonds that broke, or particles that cracked where bonds cannot break: in the order of time,
  /// within a step in that of their numbers.
  const std::vector<Index>& broken;
  /// Finds the forces of supports and of what drives the body, inertia included, zero elsewhere;
  /// shape (particles, width) [force].
  std::function<std::vector<double>()> reactions = {};
};

using BondRunObserver = RunObserver<BondRunState>;

/// Sums over the particles of a block, or of all blocks.
struct MotionSums {
  double fractured = 0.0;  ///< since the beginning, as is the work [force length]
  MotionWork work;
  double stored = 0.0, kinetic = 0.0;  ///< where a run measures them [force length]
  double loaded = 0.0;                 ///< the same of reference forces times displacements
  double driven = 0.0;    ///< in the last step: reactions times prescribed motions [force length]
  double supports = 0.0;  ///< reactions of supports along the load [force]
};

/// Component whose prescribed motion or load is the largest.
int main_component(const LoadedNetwork& problem);

/// A network of bonds in motion: what explicit runs through time and dynamic relaxations have in
/// common. Blocks of particles may be worked on at once, each stage for all of them before the
/// next begins.
struct MovingBonds {
  /// At rest, with nothing broken.
  /// \param problem  has to outlive this, and so has `masses`
  MovingBonds(const LoadedNetwork& problem, const Inertia& masses,
              std::unique_ptr<ExplicitBonds> elements, double step_length);

  /// Sums over neighbours, needed before forces where the bonds have states.
  void prepare(Index block, Index step);
  /// Internal forces, those of supports that give way included; breaks what reaches its limit.
  void find_forces(Index block, Index step);
  /// Half of u_(n-1)' K u_n of the particles [begin, end) [force length].
  double stored(Index begin, Index end) const;
  bool is_held(std::size_t slot) const { return unknowns.number[slot] == no_index; }
  /// Force on a prescribed component while its velocity becomes `faster` [force].
  double holding_force(std::size_t slot, double load_factor, double faster, double damping) const {
    const double v = motion.velocity[slot], m = mass[slot];
    return m * (faster - v) / time_step + 0.5 * damping * m * (v + faster) + force[slot] -
           load_factor * loads[slot];
  }
  /// BondRunState::reactions.
  /// \param increment  part of the prescribed displacements that this step adds
  std::vector<double> reactions(double load_factor, double increment, double damping) const;
  /// Counts the force that holds a prescribed component [force].
  void add_reaction(std::size_t slot, double reaction, MotionSums& to) const;
  MotionSums total() const;

  /// Force on the driven particles, or that of the loads, and the reactions of supports.
  void note_reactions(const MotionSums& all, double load_factor, ExplicitRecord& record) const;
  /// Displacement at the driven or loaded particles, and how much has broken.
  /// \param motion_factor  part of the prescribed displacements that is reached
  void note_motion(const MotionSums& all, double motion_factor, ExplicitRecord& record);
  /// To be called by one thread between two steps.
  BondRunState state(std::function<std::vector<double>()> reactions_now = {}) {
    return {network, motion, *bonds, broken.so_far(), std::move(reactions_now)};
  }

  const Network& network;
  const Unknowns& unknowns;
  const std::vector<double>& loads;  ///< at load factor 1
  const ReferenceLoad& reference;
  const std::vector<double>& mass;
  std::unique_ptr<ExplicitBonds> bonds;
  double time_step;
  int component;  ///< in which the reaction of supports is counted
  ParticleBlocks blocks;
  BreakOrder broken;
  BondMotion motion;
  std::vector<double> force;     ///< internal, shape (particles, width)
  std::vector<MotionSums> sums;  ///< per block

 private:
  void lose(Index block, Index step, const BondLosses& losses);
};

}  // namespace perilink
