#include "analysis/quasistatic/events/single_event_engine.hpp"

#include <limits>

namespace perilink {

SingleEventEngine::SingleEventEngine(const LoadedNetwork& problem, const EngineOptions& options)
    : network_(problem.network),
      threads_(options.threads),
      equilibrium_(problem, options),
      search_(make_break_search(network_)),
      closes_(network_.has_closing()),
      teeth_(static_cast<std::size_t>(network_.num_elements()), 0) {
  if (network_.has_crushing()) crushing_.emplace(network_);
}

Event SingleEventEngine::next_event() {
  const BreakSearch::Hit hit =
      search_->find(equilibrium_.where_elements_fail(), tie_tolerance, threads_);
  if (hit.element == no_index) return {};
  return {hit.element, 1.0 / hit.ratio};
}

EventOutcome SingleEventEngine::apply(const Event& event) {
  const BondLaw& law = network_.law(event.element);
  const bool compressed =
      law.crushes() && is_shorter(network_, event.element, equilibrium_.where_elements_fail());
  const int next = BondLaw::after(teeth_[event.element], compressed);
  const EventOutcome outcome = equilibrium_.weaken(event.element, law.tooth(next).secant);
  if (outcome.mechanism) return outcome;
  teeth_[event.element] = next;
  set_limits(event.element);
  return outcome;
}

void SingleEventEngine::set_limits(Index element) {
  const double limit = limit_of(element);
  if (!network_.law(element).crushes()) return search_->set_limit(element, limit);
  const int tooth = teeth_[element];
  constexpr double none = std::numeric_limits<double>::infinity();
  search_->set_limits(element, tooth > 0 ? limit : none, tooth > 0 ? none : limit);
  if (tooth != 1) return;
  for (const Index woken : crushing_->wake(element)) {
    if (teeth_[woken] != 0 || secants()[woken] == 0.0) continue;
    const double first = network_.law(woken).first_in_compression().limit;
    search_->set_limits(woken, limit_of(woken), network_.critical_stretch[woken] * first);
  }
}

double SingleEventEngine::limit_of(Index element) const {
  const Tooth tooth = network_.law(element).tooth(teeth_[element]);
  return tooth.secant == 0.0 ? std::numeric_limits<double>::infinity()
                             : network_.critical_stretch[element] * tooth.limit;
}

int SingleEventEngine::cut(std::span<const Index> elements) {
  int springs = 0;
  for (const Index element : elements) {
    springs += equilibrium_.cut(element);
    search_->set_limit(element, std::numeric_limits<double>::infinity());
  }
  return springs;
}

}  // namespace perilink
