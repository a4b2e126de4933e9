#include "analysis/quasistatic/events/event_engine.hpp"

#include "analysis/quasistatic/events/single_event_engine.hpp"

namespace perilink {

std::unique_ptr<EventEngine> make_event_engine(const LoadedNetwork& problem,
                                               const EngineOptions& options) {
  switch (options.kind) {
    case EngineKind::single_events: return std::make_unique<SingleEventEngine>(problem, options);
  }
  return nullptr;
}

}  // namespace perilink
