#include <algorithm>
#include <cmath>

#include "analysis/quasistatic/event_run.hpp"

namespace perilink {
namespace {

/// Hosts at this fraction of the bond or strain that triggers a release are released too [-].
constexpr double as_near = 0.9;

/// Notes missed releases. A freed bond that fails before the load factor of its release exceeded
/// its limit by more than the release threshold allows.
/// \param sense  1 if the load factor grows, -1 if it falls
/// \return whether the analysis must begin again
bool note_missed_releases(PathState& path, const DamageOptions& options, const Event& event,
                          double sense) {
  for (const auto& [bonds, released_at] : path.freed) {
    const auto is_freed = [&](Index element) {
      return std::binary_search(bonds.begin(), bonds.end(), element);
    };
    const bool freed = is_freed(event.element) || std::ranges::any_of(event.others, is_freed);
    const double near = std::max(tie_tolerance, options.engine.event_tolerance);
    const bool earlier = event.at_constant_load ||
                         sense * (released_at - event.load_factor) > near * std::abs(released_at);
    const bool begins = path.row.step == 0 && path.events == 0;  // no event by then
    if (begins || !freed || !earlier) continue;
    if (options.begins_again) return true;
    ++path.result.missed_releases;
  }
  path.freed.clear();
  return false;
}

}  // namespace

/// Releases hosts if that comes before the event. They are the hosts of the next bond and of bonds
/// nearly as close to their limits, or the most strained hosts.
/// \param sense  1 if the load factor grows, -1 if it falls
/// \param most   load factor up to which events and releases count
/// \return whether hosts were released; then the event must be searched for again. Not if a missed
///         release ends the run.
bool EventRun::converts(const Event& event, double sense, double most) {
  if (!host_release_ || event.changes_side) return false;
  const bool fails = event.element != no_index && event.load_factor <= most;
  if (host_release_->strains()) {
    const auto [flags, load_factor] =
        host_release_->strained(engine_->where_elements_fail(), as_near);
    const double next = fails ? event.load_factor : most;
    if (std::isfinite(load_factor) && load_factor <= next) {
      take_over(host_release_->convert(flags), load_factor);
      return true;
    }
  }
  if (!fails) return false;
  std::vector<Index> failing = event.others;
  failing.push_back(event.element);
  const auto is_embedded = [&](Index element) { return host_release_->is_embedded(element); };
  if (std::ranges::none_of(failing, is_embedded)) {
    if (note_missed_releases(path_, options_, event, sense)) missed_ = host_release_->whole();
    return false;
  }
  std::vector<Index> near = engine_->near_events(event, as_near);
  near.insert(near.end(), failing.begin(), failing.end());
  take_over(host_release_->convert(host_release_->hosts_of(near)), event.load_factor);
  return true;
}

/// Adopts the motion after a host release.
/// \param load_factor  at which the release was triggered
void EventRun::take_over(const Unknowns& unknowns, double load_factor) {
  adopt(unknowns);
  engine_->set_release_threshold(host_release_->freed(), 1.0);
  path_.freed.emplace_back(host_release_->freed(), load_factor);
  ++path_.result.conversions;
  path_.result.unknowns = unknowns.count;
  path_.result.elements = host_release_->num_whole();
}

void begin_with_hosts(LoadedNetwork& problem, const std::vector<std::uint8_t>& whole) {
  EmbeddedBody& body = *problem.embedded;
  body.whole = whole;
  problem.unknowns = embedded_motion(body.hosts, body.free, whole);
}

}  // namespace perilink
