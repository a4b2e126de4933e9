#include "analysis/dynamics/bonds/runs/run_share.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace perilink {
namespace {

/// Requests of the root during a synchronisation; no value equals a Service.
enum class Wish : int { motion = 100, secants, go_on, leave };

/// Bonds of the root; secants() also collects the secants of the workers.
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
  void save(MovingElements& /*state*/) const override { refuse(); }
  void restore(const MovingElements& /*state*/) override { refuse(); }

 private:
  [[noreturn]] static void refuse() {
    throw std::logic_error("runs shared by several processes have no saved states");
  }

  std::unique_ptr<ExplicitBonds> own_;
  LeadingShare& share_;
};

/// Returns the stencil of a part. Groups of ghosts are empty.
BondStencil cut_stencil(const BondStencil& stencil, const BodyPart& part) {
  const std::vector<Index>& elements = part.elements;
  const Index first = part.first_particle;
  BondStencil own;
  own.rest = in_part(stencil.rest, elements);
  if (stencil.kinds.empty()) return own;
  constexpr Index lanes = BondStencil::lanes;
  own.kinds = stencil.kinds;
  own.patterns = stencil.patterns;
  own.patterns.emplace_back();
  const int nothing = static_cast<int>(stencil.patterns.size());
  own.groups.assign(static_cast<std::size_t>(part.own_begin / lanes), {nothing, 0});
  for (Index g = (first + part.own_begin) / lanes; g * lanes < first + part.own_end; ++g) {
    const auto& [pattern, slot] = stencil.groups[g];
    own.groups.push_back({pattern, own.element.size()});
    const std::size_t slots = stencil.patterns[pattern].size() * BondStencil::line_slots;
    for (std::size_t k = slot; k < slot + slots; ++k) {
      const Index e = stencil.element[k];
      const auto at = std::lower_bound(elements.begin(), elements.end(), e);
      own.element.push_back(e == no_index ? e : static_cast<Index>(at - elements.begin()));
    }
  }
  return own;
}

template <class Part, class Visit>
void for_each_bond_member(Part& own, Visit visit) {
  visit(own.part.body.loads.forces);
  visit(own.part.body.reference);
  visit(own.component);
  visit(own.mass);
  visit(own.stencil.kinds);
  visit(own.stencil.groups);
  visit(own.stencil.element);
  visit(own.stencil.rest);
}

void add_supports(const std::vector<double>& of_rank, std::vector<double>& of_steps) {
  const std::size_t blocks = of_rank.size() / std::max<std::size_t>(1, of_steps.size());
  for (std::size_t k = 0; k < of_rank.size(); ++k) of_steps[k / blocks] += of_rank[k];
}

void send_to_all(Ranks& ranks, Wish wish) {
  Parcel parcel;
  parcel.put(wish);
  for (int rank = 1; rank < ranks.count(); ++rank) ranks.send(rank, parcel.bytes());
}

ParticleBlocks blocks_of(const BodyPart& part) {
  return {part.body.network.particles.size(), part.body.unknowns.width};
}

}  // namespace

bool can_be_shared(const LoadedNetwork& problem, const Ranks* ranks) {
  const Network& network = problem.network;
  return ranks != nullptr && !network.has_states() &&
         ParticleBlocks(network.particles.size(), network.width()).count() >= ranks->count();
}

BondPart cut_part(const LoadedNetwork& body, const std::vector<double>& mass,
                  const BondStencil& stencil, const Partition& partition, int rank) {
  const Index first = partition.first_particle[rank], past = partition.past_particle[rank];
  const int width = body.unknowns.width;
  BondPart own;
  own.part = cut_part(body.network, body.unknowns, partition, rank);
  own.part.body.loads.forces = slice(body.loads.forces, first, past, width);
  own.part.body.reference = body.reference;
  own.component = main_component(body);
  own.mass = slice(mass, first, past, width);
  own.stencil = cut_stencil(stencil, own.part);
  return own;
}

void BondPart::pack(Parcel& parcel) const {
  part.pack(parcel);
  for_each_bond_member(*this, [&](const auto& member) { parcel.put(member); });
  parcel.put(stencil.patterns.size());
  for (const auto& pattern : stencil.patterns) parcel.put(pattern);
}

BondPart BondPart::unpack(Parcel& parcel) {
  BondPart own;
  own.part = BodyPart::unpack(parcel);
  for_each_bond_member(own, [&](auto& member) { parcel.get(member); });
  own.stencil.patterns.resize(parcel.get<std::size_t>());
  for (auto& pattern : own.stencil.patterns) parcel.get(pattern);
  return own;
}

RunShare::RunShare(Ranks& ranks, const Unknowns& unknowns, const ParticleBlocks& blocks,
                   Index first_block, Index past_block, const Ghosts& ghosts)
    : ranks_(ranks),
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

LeadingShare::LeadingShare(Ranks& ranks, const LoadedNetwork& body, const Partition& partition)
    : RunShare(ranks, body.unknowns, partition.blocks, 0, partition.first_block[1],
               partition.ghosts(body.network, 0)),
      partition_(partition) {}

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
  supports_.clear();
  steps_ = 0;
  return supports;
}

void LeadingShare::collect_motion(MovingBonds& body) {
  send_to_all(ranks_, Wish::motion);
  for (int rank = 1; rank < ranks_.count(); ++rank) {
    Parcel answer(ranks_.receive(rank));
    const auto begin = std::ptrdiff_t{partition_.own_begin(rank)} * width_;
    for (std::vector<double>* all :
         {&body.motion.displacement, &body.motion.velocity, &body.force}) {
      std::vector<double> own;
      answer.get(own);
      std::copy(own.begin(), own.end(), all->begin() + begin);
    }
  }
}

void LeadingShare::collect_secants(std::span<double> secants) {
  // An observer calls this, and its exceptions end a run with all files written. Unread answers of
  // workers would block that, so exceptions here end all ranks.
  lead(ranks_, [&] {
    send_to_all(ranks_, Wish::secants);
    for (int rank = 1; rank < ranks_.count(); ++rank) {
      Parcel answer(ranks_.receive(rank));
      std::vector<Index> elements;
      std::vector<double> own;
      answer.get(elements);
      answer.get(own);
      for (std::size_t k = 0; k < own.size(); ++k) secants[elements[k]] = own[k];
    }
  });
}

void LeadingShare::end_meeting(bool goes_on) {
  send_to_all(ranks_, goes_on ? Wish::go_on : Wish::leave);
}

FollowingShare::FollowingShare(Ranks& ranks, const BodyPart& part)
    : RunShare(ranks, part.body.unknowns, blocks_of(part), blocks_of(part).of(part.own_begin),
               blocks_of(part).of(part.own_end - 1) + 1, part.ghosts),
      part_(part) {}

void FollowingShare::report(MovingBonds& body) {
  Parcel parcel;
  parcel.put(supports_);
  supports_.clear();
  parcel.put(
      std::vector<MotionSums>(body.sums.begin() + first_block_, body.sums.begin() + past_block_));
  std::vector<BreakOrder::Break> broken = body.broken.take_latest();
  for (auto& [step, number] : broken) number = part_.elements[number];
  parcel.put(broken);
  ranks_.send(0, parcel.bytes());
}

bool FollowingShare::meet(MovingBonds& body) {
  report(body);
  for (;;) {
    const Wish wish = Parcel(ranks_.receive(0)).get<Wish>();
    if (wish < Wish::motion) {
      throw std::logic_error("the root ended a run while workers wait in it");
    }
    if (wish == Wish::go_on || wish == Wish::leave) return wish == Wish::go_on;
    Parcel answer;
    if (wish == Wish::secants) {
      answer.put(part_.elements);
      answer.put(body.bonds->secants());
    } else {
      for (const auto* all : {&body.motion.displacement, &body.motion.velocity, &body.force}) {
        answer.put(slice(*all, part_.own_begin, part_.own_end, width_));
      }
    }
    ranks_.send(0, answer.bytes());
  }
}

std::unique_ptr<ExplicitBonds> leading_bonds(std::unique_ptr<ExplicitBonds> own,
                                             LeadingShare& share) {
  return std::make_unique<LeadingBonds>(std::move(own), share);
}

}  // namespace perilink
