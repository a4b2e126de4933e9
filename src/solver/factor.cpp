#include "solver/factor.hpp"

#include <algorithm>
#include <atomic>
#include <vector>

#include "solver/cholmod_updown_factor.hpp"
#include "solver/factor_count.hpp"
#include "solver/in_place_factor.hpp"
#include "solver/refactorizing_factor.hpp"

namespace perilink {

void Factor::compliance(std::span<const SparseVector> x, std::span<double> result) {
  std::vector<double> direction(static_cast<std::size_t>(statistics().size));
  for (std::size_t b = 0; b < x.size(); ++b) {
    std::fill(direction.begin(), direction.end(), 0.0);
    for (int k = 0; k < x[b].size(); ++k) direction[x[b].rows[k]] = x[b].values[k];
    solve(direction, direction);
    for (std::size_t a = 0; a < x.size(); ++a) {
      double sum = 0.0;
      for (int k = 0; k < x[a].size(); ++k) sum += x[a].values[k] * direction[x[a].rows[k]];
      result[a * x.size() + b] = sum;
    }
  }
}

void Factor::downdate(std::span<const SparseVector> x, std::span<const double> load_changes,
                      std::span<const double> /*pivots*/, std::span<double> solution) {
  for (std::size_t a = 0; a < x.size(); ++a) {
    prepare_downdate(x[a]);
    commit_downdate(load_changes[a], solution);
  }
}

namespace {

std::atomic<int> made = 0;

}  // namespace

int factors_made() { return made; }

std::unique_ptr<Factor> make_factor(FactorRoute route, int threads) {
  ++made;
  switch (route) {
    case FactorRoute::in_place: return std::make_unique<InPlaceFactor>(threads);
    case FactorRoute::cholmod_updown: return std::make_unique<CholmodUpdownFactor>();
    case FactorRoute::refactorize: return std::make_unique<RefactorizingFactor>();
  }
  return nullptr;
}

FactorStatistics estimate_factor(const SparseMatrix& matrix, std::span<const Index> groups) {
  CholmodSession session;
  const CholmodFactorPtr factor = analyze_supernodal(session, matrix, groups);
  FactorStatistics result;
  result.size = static_cast<Index>(factor->n);
  result.entries = static_cast<double>(factor->xsize);
  result.bytes = 8.0 * result.entries + 4.0 * static_cast<double>(factor->ssize);
  result.flops = session.get()->fl;
  return result;
}

std::string to_string(FactorRoute route) {
  switch (route) {
    case FactorRoute::in_place: return "in_place";
    case FactorRoute::cholmod_updown: return "cholmod_updown";
    case FactorRoute::refactorize: return "refactorize";
  }
  return "unknown";
}

}  // namespace perilink
