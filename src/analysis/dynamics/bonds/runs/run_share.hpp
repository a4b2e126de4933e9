#pragma once

#include <memory>
#include <span>
#include <vector>

#include "analysis/dynamics/bonds/bond_stencil.hpp"
#include "analysis/dynamics/bonds/moving_bonds.hpp"
#include "analysis/ranks/body_part.hpp"
#include "solver/ranks.hpp"

namespace perilink {

/// Whether ranks share the work on these bonds: there are several, a block of particles at least
/// for each, and the network has no states.
/// \param ranks  null: this process is alone
bool can_be_shared(const LoadedNetwork& problem, const Ranks* ranks);

/// The part of a body whose bonds a rank moves.
struct BondPart {
  BodyPart part;             ///< with the loads of its particles
  int component = 0;         ///< main_component() of the whole body
  std::vector<double> mass;  ///< shape (particles, width)
  BondStencil stencil;       ///< cut out of that of the whole body, so that sums keep their order

  void pack(Parcel& parcel) const;
  static BondPart unpack(Parcel& parcel);
};

/// \param mass  shape (particles, width)
BondPart cut_part(const LoadedNetwork& body, const std::vector<double>& mass,
                  const BondStencil& stencil, const Partition& partition, int rank);

/// The share of a rank in a run of moving bonds: it moves its own blocks, and in every step ranks
/// bring the motion of their ghosts up to date. In meetings every few steps the first rank takes
/// the sums of all blocks and the broken bonds, may ask for more, and ends the meeting.
class RunShare {
 public:
  /// \param unknowns  motion of the particles that the rank numbers
  RunShare(Ranks& ranks, const Unknowns& unknowns, const ParticleBlocks& blocks, Index first_block,
           Index past_block, const Ghosts& ghosts);

  Index first_block() const { return first_block_; }
  Index past_block() const { return past_block_; }

  /// Collective. Bonds that break need the velocities, too.
  void update_ghosts(BondMotion& motion) {
    layer_.update(width_, {motion.displacement, motion.velocity});
  }

  /// Once in every step: reactions of supports [force] for the next meeting.
  void note_supports(const MovingBonds& body) {
    for (const Index block : held_blocks_) supports_.push_back(body.sums[block].supports);
    ++steps_;
  }

 protected:
  Ranks& ranks_;
  int width_;  ///< components of the motion of a particle
  Index first_block_, past_block_;
  std::vector<double> supports_;  ///< since the last meeting, shape (steps, held blocks)
  Index steps_ = 0;               ///< since the last meeting

 private:
  std::vector<Index> held_blocks_;  ///< own blocks in which something is held, ascending
  GhostLayer layer_;
};

/// The share of the first rank. Its numbers are those of the whole body.
class LeadingShare final : public RunShare {
 public:
  LeadingShare(Ranks& ranks, const LoadedNetwork& body, const Partition& partition);

  /// Begins a meeting, or comes after the last step: takes sums and broken bonds into `body`.
  /// \return reactions of supports in each step since the last meeting, summed in the order of the
  ///         blocks as one process does [force]
  std::vector<double> collect(MovingBonds& body);
  /// During a meeting: the motion of all particles and the forces on them.
  void collect_motion(MovingBonds& body);
  /// During a meeting. \param secants  of all elements; those of other ranks are overwritten
  void collect_secants(std::span<double> secants);
  void end_meeting(bool goes_on);

 private:
  Partition partition_;
};

/// The share of another rank.
class FollowingShare final : public RunShare {
 public:
  /// \param part  has to outlive this
  FollowingShare(Ranks& ranks, const BodyPart& part);

  /// A meeting. \return whether the run goes on
  bool meet(MovingBonds& body);
  /// Comes after the last step.
  void report(MovingBonds& body);

 private:
  const BodyPart& part_;
};

/// The share of this process in a run; both null: it is alone.
struct Shares {
  LeadingShare* leading = nullptr;
  FollowingShare* following = nullptr;

  RunShare* own() const { return leading != nullptr ? static_cast<RunShare*>(leading) : following; }
  Index first_block() const { return own() != nullptr ? own()->first_block() : 0; }
  Index past_block(const ParticleBlocks& all) const {
    return own() != nullptr ? own()->past_block() : all.count();
  }
};

/// The bonds of the first rank, which asks the others for the secants of their elements.
std::unique_ptr<ExplicitBonds> leading_bonds(std::unique_ptr<ExplicitBonds> own,
                                             LeadingShare& share);

}  // namespace perilink
