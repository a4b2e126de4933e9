#include "analysis/dynamics/bonds/runs/run_share.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "base/parcel.hpp"

namespace perilink {
namespace {

/// What the first rank asks for in a meeting; no number is that of a Service.
enum class Wish : int { motion = 100, secants, go_on, leave };

void ask(Ranks& ranks, Wish wish) {
  Parcel parcel;
  parcel.put(wish);
  for (int rank = 1; rank < ranks.count(); ++rank) ranks.send(rank, parcel.bytes());
}

/// Components of the own particles.
std::vector<double> own_slots(const ParticleBlocks& blocks, Index first_block, Index past_block,
                              const std::vector<double>& all) {
  return {all.begin() + static_cast<std::ptrdiff_t>(blocks.first_slot(first_block)),
          all.begin() + static_cast<std::ptrdiff_t>(blocks.last_slot(past_block - 1))};
}

}  // namespace

RunShare::RunShare(Ranks& ranks, const Unknowns& unknowns, const ParticleBlocks& blocks,
                   Index first_block, Index past_block, const Ghosts& ghosts)
    : ranks_(ranks), first_block_(first_block), past_block_(past_block) {
  const auto particles = static_cast<Index>(unknowns.number.size() / unknowns.width);
  layer_ = ranks.make_ghost_layer(particles, ghosts, unknowns.width);
  for (Index b = first_block; b < past_block; ++b) {
    bool is_held = false;
    blocks.for_slots(b, [&](std::size_t slot) { is_held |= unknowns.number[slot] == no_index; });
    if (is_held) held_blocks_.push_back(b);
  }
}

void RunShare::note_supports(const MovingBonds& body) {
  for (const Index b : held_blocks_) supports_.push_back(body.sums[b].supports);
  ++steps_;
}

LeadingShare::LeadingShare(Ranks& ranks, const LoadedNetwork& body, const BlockPartition& partition)
    : RunShare(ranks, body.unknowns, partition.blocks, 0, partition.first_block[1],
               partition.ghosts(body.network, 0)),
      partition_(partition) {}

/// In the order of the blocks, so that the sums are those of one process.
void LeadingShare::add_supports(std::span<const double> of_rank, std::span<double> of_steps) {
  const std::size_t blocks = of_rank.size() / std::max<std::size_t>(1, of_steps.size());
  for (std::size_t k = 0; k < of_rank.size(); ++k) of_steps[k / blocks] += of_rank[k];
}

std::vector<double> LeadingShare::collect(MovingBonds& body) {
  std::vector<double> supports(static_cast<std::size_t>(steps_), 0.0);
  add_supports(supports_, supports);
  for (int rank = 1; rank < ranks_.count(); ++rank) {
    Parcel parcel(ranks_.receive(rank));
    std::vector<double> of_rank;
    parcel.get(of_rank);
    add_supports(of_rank, supports);
    std::vector<MotionSums> sums;
    parcel.get(sums);
    std::copy(sums.begin(), sums.end(), body.sums.begin() + partition_.first_block[rank]);
    std::vector<BreakOrder::Break> broken;
    parcel.get(broken);
    for (const auto& [step, number] : broken) {
      body.broken.add(partition_.first_block[rank], step, {&number, 1});
    }
  }
  forget_supports();
  return supports;
}

void LeadingShare::collect_motion(BondMotion& motion) {
  ask(ranks_, Wish::motion);
  for (int rank = 1; rank < ranks_.count(); ++rank) {
    Parcel parcel(ranks_.receive(rank));
    const auto begin =
        static_cast<std::ptrdiff_t>(partition_.blocks.first_slot(partition_.first_block[rank]));
    for (std::vector<double>* all : {&motion.displacement, &motion.velocity}) {
      std::vector<double> own;
      parcel.get(own);
      std::copy(own.begin(), own.end(), all->begin() + begin);
    }
  }
}

void LeadingShare::collect_secants(std::span<double> secants) {
  // An observer asks: its failures end a run in good order, which answers left unread do not.
  lead(ranks_, [&] {
    ask(ranks_, Wish::secants);
    for (int rank = 1; rank < ranks_.count(); ++rank) {
      Parcel parcel(ranks_.receive(rank));
      std::vector<Index> elements;
      std::vector<double> own;
      parcel.get(elements);
      parcel.get(own);
      for (std::size_t k = 0; k < own.size(); ++k) secants[elements[k]] = own[k];
    }
  });
}

void LeadingShare::tell(bool goes_on) { ask(ranks_, goes_on ? Wish::go_on : Wish::leave); }

FollowingShare::FollowingShare(Ranks& ranks, const BondPart& part)
    : RunShare(ranks, part.body.unknowns,
               ParticleBlocks(part.body.network.particles.size(), part.body.unknowns.width),
               part.first_block, part.past_block, part.ghosts),
      part_(part) {}

void FollowingShare::report(MovingBonds& body) {
  Parcel parcel;
  parcel.put(supports_);
  forget_supports();
  parcel.put(
      std::vector<MotionSums>(body.sums.begin() + first_block(), body.sums.begin() + past_block()));
  std::vector<BreakOrder::Break> broken = body.broken.take_latest();
  for (auto& [step, number] : broken) number = part_.elements[number];
  parcel.put(broken);
  ranks_.send(0, parcel.bytes());
}

bool FollowingShare::meet(MovingBonds& body) {
  report(body);
  for (;;) {
    const Wish wish = Parcel(ranks_.receive(0)).get<Wish>();
    if (wish == Wish::go_on || wish == Wish::leave) return wish == Wish::go_on;
    Parcel answer;
    if (wish == Wish::motion) {
      for (const std::vector<double>* all : {&body.motion.displacement, &body.motion.velocity}) {
        answer.put(own_slots(body.blocks, first_block(), past_block(), *all));
      }
    } else if (wish == Wish::secants) {
      answer.put(part_.elements);
      answer.put(body.bonds->secants());
    } else {
      throw std::logic_error("the first rank has left a run in which others wait for it");
    }
    ranks_.send(0, answer.bytes());
  }
}

}  // namespace perilink
