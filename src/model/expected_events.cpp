#include "model/expected_events.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "network/bond_softening.hpp"

namespace perilink {
namespace {

/// Range of a coordinate.
struct Extent {
  double low = infinity, high = -low;
  void add(double x) {
    low = std::min(low, x);
    high = std::max(high, x);
  }
  double length() const { return high - low; }
};

/// Returns the direction of the body's longest side.
std::size_t longest_side(const Particles& particles) {
  std::vector<Extent> sides(static_cast<std::size_t>(particles.dim));
  for (std::size_t k = 0; k < particles.positions.size(); ++k) {
    sides[k % sides.size()].add(particles.positions[k]);
  }
  const auto longest = std::ranges::max_element(sides, {}, &Extent::length);
  return static_cast<std::size_t>(longest - sides.begin());
}

}  // namespace

std::optional<double> expected_events(const Network& network) {
  if (network.has_sections() || network.first_slip_spring < network.num_elements()) return {};
  double events = 0.0;
  for (const InterfaceBonds& face : network.interfaces) {
    events += static_cast<double>(face.count) * face.strength.segments;
  }
  if (events > 0.0) return events;
  std::vector<Index> segments;
  for (const BondLaw& law : network.laws) {
    segments.push_back(law.endless() ? 0 : count_segments(law));
  }
  const std::size_t side = longest_side(network.particles);
  Extent extent;
  for (Index e = 0; e < network.num_elements(); ++e) {
    if (!network.can_break(e)) continue;
    const double first = network.particles.position(network.bonds.first[e])[side];
    const double second = network.particles.position(network.bonds.second[e])[side];
    extent.add(first);
    extent.add(second);
    events += std::abs(second - first) * segments[network.law_of.empty() ? 0 : network.law_of[e]];
  }
  if (!(events > 0.0)) return {};
  return events / extent.length();
}

double expected_batch(double events, double tolerance) {
  return std::max(1.0, 27.0 * tolerance * std::cbrt(events));
}

}  // namespace perilink
