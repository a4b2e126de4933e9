#pragma once

#include <memory>
#include <span>
#include <vector>

#include "analysis/dynamics/bonds/bond_stencil.hpp"
#include "analysis/dynamics/bonds/moving_bonds.hpp"
#include "analysis/ranks/body_part.hpp"
#include "solver/ranks.hpp"

namespace perilink {

/// Returns whether ranks can share an explicit run of bonds: there are several ranks, at least one
/// block of particles for each, and the network has no states.
/// \param ranks  null: one process
bool can_be_shared(const LoadedNetwork& problem, const Ranks* ranks);

/// Part of a body on one rank of an explicit run.
struct BondPart {
  BodyPart part;             ///< part with the loads of its particles
  int component = 0;         ///< main_component() of the whole body
  std::vector<double> mass;  ///< Returns the part of a rank. \param mass  shape (particles, width)
  BondStencil stencil;  ///< cut out of the stencil of the whole body, so that sums keep their order

  void pack(Parcel& parcel) const;
  static BondPart unpack(Parcel& parcel);
};

/// \param mass  shape (particles, width)
BondPart cut_part(const LoadedNetwork& body, const std::vector<double>& mass,
                  const BondStencil& stencil, const Partition& partition, int rank);

/// Part of the body that a rank computes in an explicit run of bonds. A rank moves its own blocks
/// and exchanges the motion of ghosts in every step. Ranks synchronise every few steps: the root
/// collects the sums of all blocks and the broken bonds, may request more, and ends the
/// synchronisation.
class RunShare {
 public:
  /// \param unknowns  unknowns of the particles that the rank numbers
  RunShare(Ranks& ranks, const Unknowns& unknowns, const ParticleBlocks& blocks, Index first_block,
           Index past_block, const Ghosts& ghosts);

  Index first_block() const { return first_block_; }
  Index past_block() const { return past_block_; }

  /// Collective: updates the motions of ghosts. Breaking bonds also need velocities.
  void update_ghosts(BondMotion& motion) {
    layer_.update(width_, {motion.displacement, motion.velocity});
  }

  /// Records the reactions of supports [force] for the next synchronisation. Called once per step.
  void note_supports(const MovingBonds& body) {
    for (const Index block : held_blocks_) supports_.push_back(body.sums[block].supports);
    ++steps_;
  }

 protected:
  Ranks& ranks_;
  int width_;  ///< components of the motion of a particle
  Index first_block_, past_block_;
  /// since the last synchronisation, shape (steps, held blocks) [force]
  std::vector<double> supports_;
  Index steps_ = 0;  ///< since the last synchronisation

 private:
  std::vector<Index> held_blocks_;  ///< own blocks with prescribed components, ascending
  GhostLayer layer_;
};

/// Part of the body that the root computes. The root also collects the results of the workers.
class LeadingShare final : public RunShare {
 public:
  LeadingShare(Ranks& ranks, const LoadedNetwork& body, const Partition& partition);

  /// Begins a synchronisation and writes the sums and broken bonds of all ranks into `body`. The
  /// last call follows the last step.
  /// \return reactions of supports in each step since the last synchronisation [force], summed over
  ///         blocks in the order of one process
  std::vector<double> collect(MovingBonds& body);
  /// Collects the motion of all particles and the forces on them, during a synchronisation.
  void collect_motion(MovingBonds& body);
  /// Collects the secants of the workers, during a synchronisation.
  /// \param secants  all elements; the workers' elements are overwritten
  void collect_secants(std::span<double> secants);
  /// Ends a synchronisation.
  /// \param goes_on  the workers take further steps; false: they leave the run
  void end_meeting(bool goes_on);

 private:
  Partition partition_;
};

/// Part of the body that a worker computes.
class FollowingShare final : public RunShare {
 public:
  /// \param part  must outlive this object
  FollowingShare(Ranks& ranks, const BodyPart& part);

  /// Synchronises with the root. \return whether the run goes on
  bool meet(MovingBonds& body);
  /// Sends the results since the last synchronisation to the root.
  void report(MovingBonds& body);

 private:
  const BodyPart& part_;
};

/// Part of the body that this process computes. One pointer is set if there are several processes,
/// else none.
struct Shares {
  LeadingShare* leading = nullptr;
  FollowingShare* following = nullptr;

  RunShare* own() const { return leading != nullptr ? static_cast<RunShare*>(leading) : following; }
  Index first_block() const { return own() != nullptr ? own()->first_block() : 0; }
  Index past_block(const ParticleBlocks& all) const {
    return own() != nullptr ? own()->past_block() : all.count();
  }
};

/// Returns the bonds of the root with secants collected from all ranks.
std::unique_ptr<ExplicitBonds> leading_bonds(std::unique_ptr<ExplicitBonds> own,
                                             LeadingShare& share);

}  // namespace perilink
