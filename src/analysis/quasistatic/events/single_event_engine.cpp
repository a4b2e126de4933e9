#include "analysis/quasistatic/events/single_event_engine.hpp"

#include <limits>

namespace perilink {

SingleEventEngine::SingleEventEngine(const LoadedNetwork& problem, const EngineOptions& options)
    : network_(problem.network),
      threads_(options.threads),
      equilibrium_(problem, options),
      search_(make_break_search(network_)),
      closes_(network_.has_closing()),
      teeth_(static_cast<std::size_t>(network_.num_elements()), 0) {}

Event SingleEventEngine::next_event() {
  const BreakSearch::Hit hit =
      search_->find(equilibrium_.where_elements_fail(), tie_tolerance, threads_);
  if (hit.element == no_index) return {};
  return {hit.element, 1.0 / hit.ratio};
}

EventOutcome SingleEventEngine::apply(const Event& event) {
  const Tooth next = network_.law(event.element).tooth(teeth_[event.element] + 1);
  const EventOutcome outcome = equilibrium_.weaken(event.element, next.secant);
  if (outcome.mechanism) return outcome;
  ++teeth_[event.element];
  search_->set_limit(event.element, limit_of(event.element));
  return outcome;
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
