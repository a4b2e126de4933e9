#pragma once

#include <initializer_list>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "analysis/dynamics/bonds/bond_forces.hpp"
#include "analysis/dynamics/bonds/moving_bonds.hpp"
#include "analysis/dynamics/bonds/runs/bond_part.hpp"
#include "analysis/dynamics/meetings.hpp"
#include "solver/ranks.hpp"

namespace perilink {

/// Whether ranks can share the work on these bonds: every rank needs a block of particles.
/// \param ranks  null: this process is alone
bool can_be_shared(const LoadedNetwork& problem, const Ranks* ranks);

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
  /// Collective.
  void update_states(ExplicitBonds& bonds) { bonds.update_states(layer_); }

  /// Once in every step.
  void note_supports(const MovingBonds& body) {
    meetings_.note_step(held_blocks_, [&](Index b) { return body.sums[b].supports; });
  }

  /// Collective: sums over blocks in the order of their numbers, as one process takes them.
  /// \param own  those of the blocks that this rank moves
  /// \return the first rank's: of all blocks
  template <class Sum>
  Sum sum_in_order(std::span<const Sum> own) {
    Ranks& ranks = meetings_.ranks();
    Sum sum{};
    for (const Sum& block : own) sum += block;
    if (!ranks.leads()) put_in(0, std::vector<Sum>(own.begin(), own.end()));
    std::vector<Sum> others;
    for (int rank = 1; ranks.leads() && rank < ranks.count(); ++rank) {
      Parcel(ranks.receive(rank)).get(others);
      for (const Sum& block : others) sum += block;
    }
    return sum;
  }
  /// Collective. \return what the first rank gives
  template <class Value>
  Value of_first(const Value& value) {
    Ranks& ranks = meetings_.ranks();
    if (!ranks.leads()) return Parcel(ranks.receive(0)).get<Value>();
    for (int rank = 1; rank < ranks.count(); ++rank) put_in(rank, value);
    return value;
  }

 protected:
  Meetings meetings_;
  int width_;  ///< components of the motion of a particle

 private:
  template <class Value>
  void put_in(int rank, const Value& value) {
    Parcel parcel;
    parcel.put(value);
    meetings_.ranks().send(rank, parcel.bytes());
  }

  Index first_block_, past_block_;
  std::vector<Index> held_blocks_;
  GhostLayer layer_;
};

/// The first rank's share. Its numbers are those of the whole body.
class LeadingShare final : public RunShare {
 public:
  LeadingShare(Ranks& ranks, const LoadedNetwork& body, const BlockPartition& partition);

  /// Begins a meeting, or comes after the last step: takes sums and what broke into `body`.
  /// \return reactions of supports in each step since the last time [force]
  std::vector<double> collect(MovingBonds& body);
  /// During a meeting: the motion of all particles and the forces on them.
  void collect_motion(MovingBonds& body);
  /// During a meeting. \param secants  of all elements; those of other ranks are overwritten
  void collect_secants(std::span<double> secants);
  /// During a meeting. \param damage  of all particles; that of other ranks is overwritten
  void collect_damage(std::vector<double>& damage);
  /// Ends a meeting.
  void tell(bool goes_on) { meetings_.tell(goes_on); }

 private:
  /// Fields of shape (particles, width): those of the other ranks' particles.
  void collect_fields(Wish wish, int width, std::initializer_list<std::vector<double>*> fields);

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

/// What this process does in a run that ranks share; both null: it is alone.
struct Shares {
  LeadingShare* leading = nullptr;
  FollowingShare* following = nullptr;

  RunShare* own() const { return leading != nullptr ? static_cast<RunShare*>(leading) : following; }
  Index first_block() const { return own() != nullptr ? own()->first_block() : 0; }
  Index past_block(const ParticleBlocks& all) const {
    return own() != nullptr ? own()->past_block() : all.count();
  }
};

/// The bonds of the first rank, which asks the others what is left of theirs.
std::unique_ptr<ExplicitBonds> leading_bonds(std::unique_ptr<ExplicitBonds> own,
                                             LeadingShare& share);

/// Sends the other ranks an order and their parts of the body, and runs that of the first.
/// \param mass  shape (particles, width)
/// \param run   run(stencil, share) gives a result that tells how many ranks there were
template <class Run>
auto run_shared(Ranks& ranks, const Parcel& order, const LoadedNetwork& problem,
                const std::vector<double>& mass, Strain strain, Run run) {
  BondStencil stencil = stencil_for(problem.network, strain);
  const BlockPartition partition(problem.network, ranks.count());
  return lead(ranks, [&] {
    for (int rank = 1; rank < ranks.count(); ++rank) {
      ranks.send(rank, order.bytes());
      ranks.send(rank, cut_part(problem, mass, stencil, partition, rank).pack().bytes());
    }
    LeadingShare share(ranks, problem, partition);
    auto result = run(std::move(stencil), share);
    result.ranks = ranks.count();
    return result;
  });
}

}  // namespace perilink
