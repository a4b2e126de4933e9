#include "solver/factor_routes.hpp"

#include <atomic>

#include "solver/cholmod_support.hpp"
#include "solver/cholmod_updown_factor.hpp"
#include "solver/in_place_factor.hpp"
#include "solver/refactorizing_factor.hpp"

namespace perilink {
namespace {

std::atomic<int> made = 0;

}  // namespace

int factors_made() { return made; }

std::unique_ptr<Factor> make_factor(FactorRoute route, int threads) {
  ++made;
  switch (route) {
    case FactorRoute::in_place: return std::make_unique<InPlaceFactor>(threads);
    case FactorRoute::cholmod_updown: return std::make_unique<CholmodUpdownFactor>(threads);
    case FactorRoute::refactorize: return std::make_unique<RefactorizingFactor>(threads);
  }
  return nullptr;
}

FactorStatistics estimate_factor(const SparseMatrix& matrix, std::span<const Index> groups) {
  CholmodSession session;
  const CholmodFactorPtr factor = analyze_supernodal(session, matrix, groups);
  return measure_factor(*factor, session.get()->fl);
}

}  // namespace perilink
