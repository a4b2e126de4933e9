#include "analysis/dynamics/bonds/runs/run_share.hpp"

#include <algorithm>
#include <utility>

namespace perilink {
namespace {

/// Components of the own particles.
std::vector<double> own_slots(const ParticleBlocks& blocks, Index first_block, Index past_block,
                              const std::vector<double>& all) {
  return {all.begin() + static_cast<std::ptrdiff_t>(blocks.first_slot(first_block)),
          all.begin() + static_cast<std::ptrdiff_t>(blocks.last_slot(past_block - 1))};
}

/// The bonds of the first rank, which asks the others what is left of theirs.
class LeadingBonds final : public ExplicitBonds {
 public:
  LeadingBonds(std::unique_ptr<ExplicitBonds> own, LeadingShare& share)
      : own_(std::move(own)), share_(share) {}

  BondLosses forces(Index begin, Index end, double time_step, const BondMotion& motion,
                    std::span<double> force) override {
    return own_->forces(begin, end, time_step, motion, force);
  }
  double stored(Index begin, Index end, double time_step, const BondMotion& motion) const override {
    return own_->stored(begin, end, time_step, motion);
  }
  std::vector<double> secants() const override {
    std::vector<double> secants = own_->secants();
    share_.collect_secants(secants);
    return secants;
  }

 private:
  std::unique_ptr<ExplicitBonds> own_;
  LeadingShare& share_;
};

}  // namespace

bool can_be_shared(const LoadedNetwork& problem, const Ranks* ranks) {
  const Network& network = problem.network;
  return ranks != nullptr && !network.has_states() && network.anchors.size() == 0 &&
         ParticleBlocks(network.particles.size(), network.width()).count() >= ranks->count();
}

RunShare::RunShare(Ranks& ranks, const Unknowns& unknowns, const ParticleBlocks& blocks,
                   Index first_block, Index past_block, const Ghosts& ghosts)
    : meetings_(ranks, ranks.count()),
      first_block_(first_block),
      past_block_(past_block),
      width_(unknowns.width),
      layer_(ranks, ghosts) {
  for (Index b = first_block; b < past_block; ++b) {
    bool is_held = false;
    blocks.for_slots(b, [&](std::size_t slot) { is_held |= unknowns.number[slot] == no_index; });
    if (is_held) held_blocks_.push_back(b);
  }
}

LeadingShare::LeadingShare(Ranks& ranks, const LoadedNetwork& body, const BlockPartition& partition)
    : RunShare(ranks, body.unknowns, partition.blocks, 0, partition.first_block[1],
               partition.ghosts(body.network, 0)),
      partition_(partition) {}

std::vector<double> LeadingShare::collect(MovingBonds& body) {
  return meetings_.collect([&](int rank, Parcel& parcel) {
    std::vector<MotionSums> sums;
    parcel.get(sums);
    std::copy(sums.begin(), sums.end(), body.sums.begin() + partition_.first_block[rank]);
    std::vector<BreakOrder::Break> broken;
    parcel.get(broken);
    for (const auto& [step, number] : broken) {
      body.broken.add(partition_.first_block[rank], step, {&number, 1});
    }
  });
}

void LeadingShare::collect_motion(BondMotion& motion) {
  meetings_.ask(Wish::motion, [&](int rank, Parcel& parcel) {
    const auto begin =
        static_cast<std::ptrdiff_t>(partition_.blocks.first_slot(partition_.first_block[rank]));
    for (std::vector<double>* all : {&motion.displacement, &motion.velocity}) {
      std::vector<double> own;
      parcel.get(own);
      std::copy(own.begin(), own.end(), all->begin() + begin);
    }
  });
}

void LeadingShare::collect_secants(std::span<double> secants) {
  // An observer asks: its failures end a run in good order, which answers left unread do not.
  lead(meetings_.ranks(), [&] {
    meetings_.ask(Wish::secants, [&](int, Parcel& parcel) {
      std::vector<Index> elements;
      std::vector<double> own;
      parcel.get(elements);
      parcel.get(own);
      for (std::size_t k = 0; k < own.size(); ++k) secants[elements[k]] = own[k];
    });
  });
}

FollowingShare::FollowingShare(Ranks& ranks, const BondPart& part)
    : RunShare(ranks, part.body.unknowns,
               ParticleBlocks(part.body.network.particles.size(), part.body.unknowns.width),
               part.first_block, part.past_block, part.ghosts),
      part_(part) {}

void FollowingShare::report(MovingBonds& body) {
  meetings_.report([&](Parcel& parcel) {
    parcel.put(std::vector<MotionSums>(body.sums.begin() + first_block(),
                                       body.sums.begin() + past_block()));
    std::vector<BreakOrder::Break> broken = body.broken.take_latest();
    for (auto& [step, number] : broken) number = part_.elements[number];
    parcel.put(broken);
  });
}

bool FollowingShare::meet(MovingBonds& body) {
  report(body);
  return meetings_.obey([&](Wish wish, Parcel& parcel) {
    if (wish == Wish::secants) {
      parcel.put(part_.elements);
      parcel.put(body.bonds->secants());
      return;
    }
    for (const std::vector<double>* all : {&body.motion.displacement, &body.motion.velocity}) {
      parcel.put(own_slots(body.blocks, first_block(), past_block(), *all));
    }
  });
}

std::unique_ptr<ExplicitBonds> leading_bonds(std::unique_ptr<ExplicitBonds> own,
                                             LeadingShare& share) {
  return std::make_unique<LeadingBonds>(std::move(own), share);
}

}  // namespace perilink
