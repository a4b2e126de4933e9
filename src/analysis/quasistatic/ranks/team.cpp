#include "analysis/quasistatic/ranks/team.hpp"

#include <exception>
#include <optional>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "base/memory.hpp"

namespace perilink {
namespace {

enum class Job : int { end, take_part, search };

struct SearchOrder {
  double enough, scale;
  int most_iterations;
};

std::vector<double> take(std::span<const double> all, const std::vector<GlobalIndex>& numbers) {
  std::vector<double> own;
  own.reserve(numbers.size());
  for (const GlobalIndex k : numbers) own.push_back(entry(all, k));
  return own;
}

void add(std::span<double> all, const std::vector<GlobalIndex>& numbers,
         std::span<const double> own) {
  for (std::size_t k = 0; k < numbers.size(); ++k) entry(all, numbers[k]) += own[k];
}

/// What the first rank does for all: what goes wrong in it alone ends all ranks, which else would
/// wait for it for ever. The solver's errors are those of all ranks.
template <class Act>
auto lead(Ranks& ranks, Act act) {
  try {
    return act();
  } catch (const SolverError&) {
    throw;
  } catch (const std::exception& error) {
    ranks.abandon(failure_text(error));
    throw;  // not reached, which GCC does not see
  }
}

/// The part of a search of a rank that does not lead.
void search_along(Ranks& ranks, PartSolver& solver, Parcel& parcel) {
  const auto order = parcel.get<SearchOrder>();
  std::vector<double> right;
  parcel.get(right);
  std::vector<double> solution(right.size(), 0.0);
  try {
    solver.search(right, solution, order.enough, order.scale, order.most_iterations);
  } catch (const SolverError&) {
    return;  // the same in all ranks: the first tells it
  }
  Parcel answer;
  answer.put(solution);
  ranks.send(0, answer.bytes());
}

}  // namespace

Team::Team(Ranks& ranks, const Network& network, const Unknowns& unknowns, Secants secants,
           const BoxMotions& motions, const BoxStiffness& stiffness)
    : ranks_(ranks), partition_(share_out(network, unknowns, ranks.count())) {
  const auto part = [&](int rank) {
    return cut_part(network, secants, unknowns, motions, stiffness, partition_, rank);
  };
  own_ = lead(ranks, [&] {
    for (int rank = 1; rank < ranks.count(); ++rank) {
      Parcel order;
      order.put(Job::take_part);
      ranks.send(rank, order.bytes());
      ranks.send(rank, part(rank).pack().bytes());
    }
    return std::make_unique<PartSolver>(ranks, part(0));
  });
}

GradientsReport Team::search(std::span<const double> right, std::span<double> solution,
                             double enough, double scale, int most_iterations) {
  return lead(ranks_, [&] {
    for (int rank = 1; rank < ranks_.count(); ++rank) {
      Parcel order;
      order.put(Job::search);
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

void serve(Ranks& ranks) {
  std::optional<PartSolver> solver;
  try {
    for (;;) {
      Parcel order(ranks.receive(0));
      switch (order.get<Job>()) {
        case Job::end: return;
        case Job::take_part:
          solver.reset();
          solver.emplace(ranks, BodyPart::unpack(Parcel(ranks.receive(0))));
          break;
        case Job::search: search_along(ranks, *solver, order); break;
      }
    }
  } catch (const std::exception& error) {
    ranks.abandon(error.what());
  }
}

void dismiss(Ranks& ranks) {
  Parcel order;
  order.put(Job::end);
  for (int rank = 1; rank < ranks.count(); ++rank) ranks.send(rank, order.bytes());
}

}  // namespace perilink
