#include "analysis/quasistatic/events/event_engine.hpp"

#include "analysis/quasistatic/events/single_event_engine.hpp"

namespace perilink {

std::unique_ptr<EventEngine> make_event_engine(const LoadedNetwork& problem,
                                               const EquilibriumOptions& options) {
  return std::make_unique<SingleEventEngine>(problem, options);
}

}  // namespace perilink
