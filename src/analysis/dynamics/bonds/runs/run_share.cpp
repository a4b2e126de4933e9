#include "analysis/dynamics/bonds/runs/run_share.hpp"

#include <algorithm>
#include <utility>

namespace perilink {
namespace {

/// The bonds of the first rank, which asks the others what is left of theirs.
class LeadingBonds final : public ExplicitBonds {
 public:
  LeadingBonds(std::unique_ptr<ExplicitBonds> own, LeadingShare& share)
      : own_(std::move(own)), share_(share) {}

  bool has_states() const override { return own_->has_states(); }
  BondLosses prepare(Index begin, Index end, double time_step, const BondMotion& motion) override {
    return own_->prepare(begin, end, time_step, motion);
  }
  void update_states(GhostLayer& ghosts) override { own_->update_states(ghosts); }
  void finish_step() override { own_->finish_step(); }
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
  std::vector<double> damage() const override {
    std::vector<double> damage = own_->damage();
    if (!damage.empty()) share_.collect_damage(damage);
    return damage;
  }

 private:
  std::unique_ptr<ExplicitBonds> own_;
  LeadingShare& share_;
};

}  // namespace

bool can_be_shared(const LoadedNetwork& problem, const Ranks* ranks) {
  const Network& network = problem.network;
  return ranks != nullptr &&
         ParticleBlocks(network.particles.size(), network.width()).count() >= ranks->count();
}

RunShare::RunShare(Ranks& ranks, const Unknowns& unknowns, const ParticleBlocks& blocks,
                   Index first_block, Index past_block, const Ghosts& ghosts)
    : meetings_(ranks, ranks.count()),
      width_(unknowns.width),
      first_block_(first_block),
      past_block_(past_block),
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

void LeadingShare::collect_motion(MovingBonds& body) {
  collect_fields(Wish::motion, width_,
                 {&body.motion.displacement, &body.motion.velocity, &body.force});
}

void LeadingShare::collect_fields(Wish wish, int width,
                                  std::initializer_list<std::vector<double>*> fields) {
  meetings_.ask(wish, [&](int rank, Parcel& parcel) {
    const auto begin = static_cast<std::ptrdiff_t>(partition_.own_begin(rank)) * width;
    for (std::vector<double>* all : fields) {
      std::vector<double> own;
      parcel.get(own);
      std::copy(own.begin(), own.end(), all->begin() + begin);
    }
  });
}

void LeadingShare::collect_damage(std::vector<double>& damage) {
  lead(meetings_.ranks(), [&] { collect_fields(Wish::fields, 1, {&damage}); });
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
    for (auto& [step, number] : broken) {
      number = body.bonds->has_states() ? part_.first_particle + number : part_.elements[number];
    }
    parcel.put(broken);
  });
}

bool FollowingShare::meet(MovingBonds& body) {
  report(body);
  // Those of the own particles.
  const auto put = [&](Parcel& parcel, const std::vector<double>& all, int width) {
    const auto begin = all.begin() + std::ptrdiff_t{body.blocks.begin(first_block())} * width;
    const auto end = all.begin() + std::ptrdiff_t{body.blocks.end(past_block() - 1)} * width;
    parcel.put(std::vector<double>(begin, end));
  };
  return meetings_.obey([&](Wish wish, Parcel& parcel) {
    if (wish == Wish::secants) {
      parcel.put(part_.elements);
      parcel.put(body.bonds->secants());
    } else if (wish == Wish::fields) {
      put(parcel, body.bonds->damage(), 1);
    } else {
      put(parcel, body.motion.displacement, width_);
      put(parcel, body.motion.velocity, width_);
      put(parcel, body.force, width_);
    }
  });
}

std::unique_ptr<ExplicitBonds> leading_bonds(std::unique_ptr<ExplicitBonds> own,
                                             LeadingShare& share) {
  return std::make_unique<LeadingBonds>(std::move(own), share);
}

}  // namespace perilink
