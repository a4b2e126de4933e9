#include "analysis/quasistatic/ranks/team.hpp"

#include <algorithm>

#include "base/error.hpp"

namespace perilink {
namespace {

enum class Job : int { take_part, follow, search, search_block };

Parcel order_for(Job job) {
  Parcel order;
  order.put(Service::solve);
  order.put(job);
  return order;
}

struct SearchOrder {
  static constexpr Job job = Job::search;
  double enough, scale;
  int most_iterations;
};

struct BlockOrder {
  static constexpr Job job = Job::search_block;
  BlockRow sizes;
  double enough;
  int most_iterations;
};

std::vector<double> copy_of(std::span<const double> values) {
  return {values.begin(), values.end()};
}

/// Solves on a worker and sends the solution to the root.
template <class Order, class Search>
void search_along(Ranks& ranks, Parcel& parcel, Search search) {
  const auto order = parcel.get<Order>();
  std::vector<double> right;
  parcel.get(right);
  std::vector<double> solution(right.size(), 0.0);
  try {
    search(order, right, solution);
  } catch (const SolverError&) {
    return;  // all ranks fail together, and the root reports it
  }
  Parcel answer;
  answer.put(solution);
  ranks.send(0, answer.bytes());
}

ParticleBlocks single_particles(const Network& network, int width) {
  return {network.particles.size(), width, 1};
}

}  // namespace

bool can_be_shared(const Network& network, const Unknowns& unknowns, const Ranks* ranks) {
  return ranks != nullptr && network.particles.size() >= ranks->count() && !network.cells &&
         !network.shell && !network.has_states() && !unknowns.carries();
}

Team::Team(Ranks& ranks, const Network& network, const Unknowns& unknowns, Secants secants,
           const SubdomainMotions& motions, const SubdomainStiffness& stiffness,
           const std::vector<double>* ground)
    : ranks_(ranks), secants_(secants), ground_(ground) {
  const Partition partition(network, single_particles(network, unknowns.width), ranks.count());
  blocks_.width = static_cast<std::size_t>(unknowns.width) * block_width;
  unknowns_.first.push_back(0);
  blocks_.first.push_back(0);
  const auto part = [&](int rank) {
    PreconditionedPart own =
        cut_part(network, secants, unknowns, motions, stiffness, partition, rank);
    own.changes = ground != nullptr;
    unknowns_.first.push_back(unknowns_.first.back() + own.part.body.unknowns.count);
    blocks_.first.push_back(blocks_.first.back() + own.part.owned());
    return own;
  };
  own_ = lead(ranks, [&] {
    PreconditionedPart own = part(0);
    for (int rank = 1; rank < ranks.count(); ++rank) {
      Parcel order = order_for(Job::take_part);
      part(rank).pack(order);
      ranks.send(rank, order.bytes());
    }
    return std::make_unique<PartSolver>(ranks, std::move(own));
  });
  if (ground == nullptr) return;
  sent_other_.assign(secants.begin(), secants.end());
  for (Index e = 0; e < network.num_elements(); ++e) sent_axial_.push_back(secants.axial(e));
}

/// Comparing all elements takes negligible time compared with a solve.
void Team::send_changes() {
  BodyChanges changes;
  for (std::size_t k = 0; k < sent_other_.size(); ++k) {
    const Index e = static_cast<Index>(k);
    if (secants_[e] == sent_other_[k] && secants_.axial(e) == sent_axial_[k]) continue;
    changes.elements.push_back(e);
    changes.other.push_back(sent_other_[k] = secants_[e]);
    changes.axial.push_back(sent_axial_[k] = secants_.axial(e));
  }
  const bool has_new_ground = ground_ != nullptr && *ground_ != sent_ground_;
  if (has_new_ground) sent_ground_ = *ground_;
  if (changes.elements.empty() && !has_new_ground) return;
  for (int rank = ranks_.count() - 1; rank >= 0; --rank) {
    if (has_new_ground) changes.ground = copy_of(unknowns_.of(rank, std::span(sent_ground_)));
    if (rank == 0) return own_->follow(changes);
    Parcel order = order_for(Job::follow);
    changes.pack(order);
    ranks_.send(rank, order.bytes());
  }
}

/// \param search  called as search(own part of the right side, own part of the solution)
template <class Order, class Search>
GradientsReport Team::search_with_all(const Order& order, const Share& share,
                                      std::span<const double> right, std::span<double> solution,
                                      Search search) {
  return lead(ranks_, [&] {
    send_changes();
    for (int rank = 1; rank < ranks_.count(); ++rank) {
      Parcel parcel = order_for(Order::job);
      parcel.put(order);
      parcel.put(copy_of(share.of(rank, right)));
      ranks_.send(rank, parcel.bytes());
    }
    std::vector<double> own_right = copy_of(share.of(0, right)), own(own_right.size(), 0.0);
    const GradientsReport report = search(own_right, own);
    for (int rank = 0; rank < ranks_.count(); ++rank) {
      if (rank > 0) Parcel(ranks_.receive(rank)).get(own);
      std::ranges::transform(own, share.of(rank, solution), share.of(rank, solution).begin(),
                             std::plus());
    }
    return report;
  });
}

GradientsReport Team::search(std::span<const double> right, std::span<double> solution,
                             double enough, double scale, int most_iterations) {
  const SearchOrder order{enough, scale, most_iterations};
  return search_with_all(order, unknowns_, right, solution, [&](auto& own_right, auto& own) {
    return own_->search(own_right, own, enough, scale, most_iterations);
  });
}

GradientsReport Team::search_block(std::span<const double> right, std::span<double> solution,
                                   const BlockRow& sizes, double enough, int most_iterations) {
  std::fill(solution.begin(), solution.end(), 0.0);
  const BlockOrder order{sizes, enough, most_iterations};
  return search_with_all(order, blocks_, right, solution, [&](auto& own_right, auto& own) {
    return own_->search_block(own_right, own, sizes, enough, most_iterations);
  });
}

void TeamMember::obey(Parcel& order) {
  switch (order.get<Job>()) {
    case Job::take_part:
      solver_.reset();
      solver_.emplace(ranks_, PreconditionedPart::unpack(order));
      break;
    case Job::follow: solver_->follow(BodyChanges::unpack(order)); break;
    case Job::search:
      search_along<SearchOrder>(ranks_, order, [&](const SearchOrder& how, auto& b, auto& x) {
        solver_->search(b, x, how.enough, how.scale, how.most_iterations);
      });
      break;
    case Job::search_block:
      search_along<BlockOrder>(ranks_, order, [&](const BlockOrder& how, auto& b, auto& x) {
        solver_->search_block(b, x, how.sizes, how.enough, how.most_iterations);
      });
      break;
  }
}

}  // namespace perilink
