#pragma once

#include <span>
#include <vector>

#include "analysis/dynamics/bonds/moving_bonds.hpp"
#include "analysis/dynamics/bonds/runs/bond_part.hpp"
#include "analysis/dynamics/meetings.hpp"
#include "solver/ranks.hpp"

namespace perilink {

/// How a rank takes part in a run of moving bonds: it moves its own blocks, and ranks know of each
/// other's particles what their elements reach. In meetings the first rank takes the sums of all
/// blocks, and what has broken.
class RunShare {
 public:
  /// \param unknowns  those of the particles that the rank numbers
  RunShare(Ranks& ranks, const Unknowns& unknowns, const ParticleBlocks& blocks, Index first_block,
           Index past_block, const Ghosts& ghosts);

  Index first_block() const { return first_block_; }
  Index past_block() const { return past_block_; }

  /// Collective. Bonds that break need the velocities, too.
  void update_ghosts(BondMotion& motion) {
    layer_.update(width_, {motion.displacement, motion.velocity});
  }

  /// Once in every step.
  void note_supports(const MovingBonds& body) {
    meetings_.note_step(held_blocks_, [&](Index b) { return body.sums[b].supports; });
  }

 protected:
  Meetings meetings_;

 private:
  Index first_block_, past_block_;
  std::vector<Index> held_blocks_;
  int width_;
  GhostLayer layer_;
};

/// The first rank's share. Its numbers are those of the whole body.
class LeadingShare final : public RunShare {
 public:
  LeadingShare(Ranks& ranks, const LoadedNetwork& body, const BlockPartition& partition);

  /// Begins a meeting, or comes after the last step: takes sums and what broke into `body`.
  /// \return reactions of supports in each step since the last time [force]
  std::vector<double> collect(MovingBonds& body);
  /// During a meeting: the motion of all particles.
  void collect_motion(BondMotion& motion);
  /// During a meeting. \param secants  of all elements; those of other ranks are overwritten
  void collect_secants(std::span<double> secants);
  /// Ends a meeting.
  void tell(bool goes_on) { meetings_.tell(goes_on); }

 private:
  BlockPartition partition_;
};

/// That of the others.
class FollowingShare final : public RunShare {
 public:
  /// \param part  has to outlive this
  FollowingShare(Ranks& ranks, const BondPart& part);

  /// A meeting. \return whether the run goes on
  bool meet(MovingBonds& body);
  /// Comes after the last step.
  void report(MovingBonds& body);

 private:
  const BondPart& part_;
};

}  // namespace perilink
