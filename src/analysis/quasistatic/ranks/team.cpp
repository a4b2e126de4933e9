#include "analysis/quasistatic/ranks/team.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "solver/not_positive_definite.hpp"

namespace perilink {
namespace {

enum class Job : int { take_part, make_part, follow, search, search_block, find_forces };

Parcel order_for(Job job) {
  Parcel order;
  order.put(Service::solve);
  order.put(job);
  return order;
}

struct SearchOrder {
  double enough, scale;
  int most_iterations;
};

struct BlockOrder {
  BlockRow sizes;
  double enough;
  int most_iterations;
};

/// \param all  shape (whole body, width)
std::vector<double> take(std::span<const double> all, const std::vector<GlobalIndex>& numbers,
                         std::size_t width = 1) {
  std::vector<double> own;
  own.reserve(numbers.size() * width);
  for (const GlobalIndex k : numbers) {
    const double* first = &entry(all, k, width);
    own.insert(own.end(), first, first + width);
  }
  return own;
}

void add(std::span<double> all, const std::vector<GlobalIndex>& numbers,
         std::span<const double> own, std::size_t width = 1) {
  for (std::size_t k = 0; k < own.size(); ++k) {
    entry(all, numbers[k / width], width, k % width) += own[k];
  }
}

/// The part of a search of a rank that does not lead.
template <class Order, class Search>
void search_along(Ranks& ranks, Parcel& parcel, Search search) {
  const auto order = parcel.get<Order>();
  std::vector<double> right;
  parcel.get(right);
  std::vector<double> solution(right.size(), 0.0);
  try {
    search(order, right, solution);
  } catch (const SolverError&) {
    return;  // the same in all ranks: the first tells it
  }
  Parcel answer;
  answer.put(solution);
  ranks.send(0, answer.bytes());
}

}  // namespace

Team::Team(Ranks& ranks, const Network& network, const Unknowns& unknowns, Secants secants,
           const SubdomainMotions& motions, const SubdomainStiffness& stiffness,
           const std::vector<double>* ground)
    : ranks_(ranks),
      partition_(share_out(network, unknowns, ranks.count())),
      width_(static_cast<std::size_t>(unknowns.width)),
      secants_(secants),
      ground_(ground) {
  const auto part = [&](int rank) {
    BodyPart own = cut_part(network, secants, unknowns, motions, stiffness, partition_, rank);
    own.changes = ground != nullptr;
    return own;
  };
  own_ = lead(ranks, [&] {
    for (int rank = 1; rank < ranks.count(); ++rank) {
      Parcel order = order_for(Job::take_part);
      ranks.send(rank, order.bytes());
      ranks.send(rank, part(rank).pack().bytes());
    }
    return std::make_unique<PartSolver>(ranks, part(0));
  });
  if (ground == nullptr) return;
  told_other_.assign(secants.begin(), secants.end());
  for (Index e = 0; e < network.num_elements(); ++e) told_axial_.push_back(secants.axial(e));
}

Team::Team(Ranks& ranks, const LatticePattern& pattern, const Network& places,
           const Unknowns& unknowns, Index particles_of_box)
    : ranks_(ranks), width_(static_cast<std::size_t>(unknowns.width)) {
  const std::vector<GridWindow> windows = split_grid(pattern.grid, ranks.count());
  partition_ = share_out(pattern.grid, windows, unknowns);
  const auto share = [&](int rank) {
    return share_of(pattern, windows, places, unknowns, particles_of_box, rank);
  };
  own_ = lead(ranks, [&] {
    for (int rank = 1; rank < ranks.count(); ++rank) {
      Parcel order = order_for(Job::make_part);
      share(rank).pack(order);
      ranks.send(rank, order.bytes());
    }
    return std::make_unique<PartSolver>(ranks, make_part(ranks, share(0)));
  });
}

/// To look at all elements takes nothing beside a search.
void Team::tell_changes() {
  BodyChanges changes;
  for (std::size_t k = 0; k < told_other_.size(); ++k) {
    const Index e = static_cast<Index>(k);
    if (secants_[e] == told_other_[k] && secants_.axial(e) == told_axial_[k]) continue;
    changes.elements.push_back(GlobalIndex{e});
    changes.other.push_back(told_other_[k] = secants_[e]);
    changes.axial.push_back(told_axial_[k] = secants_.axial(e));
  }
  const bool has_new_ground = ground_ != nullptr && *ground_ != told_ground_;
  if (has_new_ground) told_ground_ = *ground_;
  if (changes.elements.empty() && !has_new_ground) return;
  for (int rank = ranks_.count() - 1; rank >= 0; --rank) {
    if (has_new_ground) changes.ground = take(told_ground_, partition_.unknowns[rank]);
    if (rank == 0) return own_->follow(changes);
    Parcel order = order_for(Job::follow);
    changes.pack(order);
    ranks_.send(rank, order.bytes());
  }
}

GradientsReport Team::search(std::span<const double> right, std::span<double> solution,
                             double enough, double scale, int most_iterations) {
  return lead(ranks_, [&] {
    tell_changes();
    for (int rank = 1; rank < ranks_.count(); ++rank) {
      Parcel order = order_for(Job::search);
      order.put(SearchOrder{enough, scale, most_iterations});
      order.put(take(right, partition_.unknowns[rank]));
      ranks_.send(rank, order.bytes());
    }
    std::vector<double> own(own_->size(), 0.0);
    const GradientsReport report =
        own_->search(take(right, partition_.unknowns[0]), own, enough, scale, most_iterations);
    add(solution, partition_.unknowns[0], own);
    for (int rank = 1; rank < ranks_.count(); ++rank) {
      Parcel(ranks_.receive(rank)).get(own);
      add(solution, partition_.unknowns[rank], own);
    }
    return report;
  });
}

GradientsReport Team::search_block(std::span<const double> right, std::span<double> solution,
                                   const BlockRow& sizes, double enough, int most_iterations) {
  return lead(ranks_, [&] {
    tell_changes();
    const std::size_t width = width_ * block_width;
    for (int rank = 1; rank < ranks_.count(); ++rank) {
      Parcel order = order_for(Job::search_block);
      order.put(BlockOrder{sizes, enough, most_iterations});
      order.put(take(right, partition_.particles[rank], width));
      ranks_.send(rank, order.bytes());
    }
    std::vector<double> own_right = take(right, partition_.particles[0], width);
    std::vector<double> own(own_right.size());
    const GradientsReport report =
        own_->search_block(own_right, own, sizes, enough, most_iterations);
    std::fill(solution.begin(), solution.end(), 0.0);
    add(solution, partition_.particles[0], own, width);
    for (int rank = 1; rank < ranks_.count(); ++rank) {
      Parcel(ranks_.receive(rank)).get(own);
      add(solution, partition_.particles[rank], own, width);
    }
    return report;
  });
}

void Team::put_in_place(int rank, std::span<const double> own, std::size_t width,
                        std::span<double> all) const {
  add(all, partition_.particles[rank], own, width);
}

InternalForce Team::internal(std::span<const double> motion) {
  return lead(ranks_, [&] {
    for (int rank = 1; rank < ranks_.count(); ++rank) {
      Parcel order = order_for(Job::find_forces);
      order.put(take(motion, partition_.particles[rank], width_));
      ranks_.send(rank, order.bytes());
    }
    InternalForce part = own_->internal(take(motion, partition_.particles[0], width_));
    InternalForce all{std::vector<double>(motion.size(), 0.0), part.energy, part.support_energy};
    add(all.forces, partition_.particles[0], part.forces, width_);
    for (int rank = 1; rank < ranks_.count(); ++rank) {
      Parcel answer(ranks_.receive(rank));
      all.energy += answer.get<double>();
      all.support_energy += answer.get<double>();
      answer.get(part.forces);
      add(all.forces, partition_.particles[rank], part.forces, width_);
    }
    return all;
  });
}

void TeamMember::find_forces(Parcel& order) {
  std::vector<double> motion;
  order.get(motion);
  const InternalForce found = solver_->internal(motion);
  Parcel answer;
  answer.put(found.energy);
  answer.put(found.support_energy);
  answer.put(found.forces);
  ranks_.send(0, answer.bytes());
}

void TeamMember::obey(Parcel& order) {
  switch (order.get<Job>()) {
    case Job::take_part:
      solver_.reset();
      solver_.emplace(ranks_, BodyPart::unpack(Parcel(ranks_.receive(0))));
      break;
    case Job::make_part:
      solver_.reset();
      try {
        solver_.emplace(ranks_, make_part(ranks_, PatternShare::unpack(order)));
      } catch (const NotPositiveDefinite&) {  // the same in all ranks: the first tells it
      }
      break;
    case Job::find_forces: find_forces(order); break;
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
