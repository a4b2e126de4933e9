#include "model/expected_events.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
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

/// Number of planes normal to an axis; a prime keeps them off the rows of lattices.
constexpr std::size_t num_planes = 1009;

/// Planes in the middle of equal parts of a range, and the bonds that cross each of them.
class Planes {
 public:
  explicit Planes(const Extent& range)
      : low_(range.low), distance_(range.length() / num_planes), changes_(num_planes + 1) {}

  void add(double from, double to, const ExpectedCrack& bond) {
    if (!(distance_ > 0.0)) return;
    const std::size_t begin = planes_below(std::min(from, to));
    const std::size_t end = planes_below(std::max(from, to));
    longest_ = std::max(longest_, end - begin);
    changes_[begin].events += bond.events;
    changes_[begin].energy += bond.energy;
    changes_[end].events -= bond.events;
    changes_[end].energy -= bond.energy;
  }

  /// Returns the bonds of the plane with the smallest fracture energy, which some bonds cross.
  ExpectedCrack weakest() const {
    const std::size_t margin = std::min(longest_, num_planes / 2);
    ExpectedCrack crossing, least{0.0, infinity};
    for (std::size_t k = 0; k < num_planes - margin; ++k) {
      crossing.events += changes_[k].events;
      crossing.energy += changes_[k].energy;
      const bool is_crossed = std::lround(crossing.events) > 0;
      if (k >= margin && is_crossed && crossing.energy < least.energy) least = crossing;
    }
    return least;
  }

 private:
  std::size_t planes_below(double x) const {
    return static_cast<std::size_t>(
        std::clamp((x - low_) / distance_ + 0.5, 0.0, 1.0 * num_planes));
  }

  double low_, distance_;
  std::size_t longest_ = 0;             ///< planes that one bond crosses, at most
  std::vector<ExpectedCrack> changes_;  ///< from the last plane to this one
};

/// Returns the events and the energy of a bond; none if it cannot break.
ExpectedCrack crack_of(const Network& network, Index bond) {
  if (!network.can_break(bond)) return {};
  return {static_cast<double>(count_segments(network.law(bond))),
          dissipated_until(network, bond, 0.0)};
}

/// Returns the crack through all weak interfaces.
ExpectedCrack crack_of_interfaces(const Network& network) {
  ExpectedCrack crack;
  for (const auto& [count, area, strength] : network.report.interfaces) {
    crack.events += static_cast<double>(count) * strength.segments;
    crack.energy += area * strength.fracture_energy;
  }
  return crack;
}

}  // namespace

double ExpectedCrack::events_left(double released) const {
  constexpr double most_beyond = 0.2, least = 0.1;
  const double cracks = released / energy;
  const double complete = std::max(1.0, std::ceil(cracks - most_beyond));
  return events * std::max(complete - cracks, least);
}

std::optional<ExpectedCrack> expected_crack(const Network& network) {
  if (network.has_sections()) return {};
  const ExpectedCrack face = crack_of_interfaces(network);
  if (face.events > 0.0) return face;
  ExpectedCrack least{0.0, infinity};
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(network.dim()); ++axis) {
    const auto ends_of = [&](Index bond) {
      const Particles& particles = network.particles;
      return std::pair(particles.position(network.bonds.first[bond])[axis],
                       particles.position(network.bonds.second[bond])[axis]);
    };
    Extent breakable;
    for (Index bond = 0; bond < network.first_contact(); ++bond) {
      if (!network.can_break(bond)) continue;
      const auto [first, second] = ends_of(bond);
      breakable.add(first);
      breakable.add(second);
    }
    Planes planes(breakable);
    for (Index bond = 0; bond < network.first_contact(); ++bond) {
      const auto [first, second] = ends_of(bond);
      planes.add(first, second, crack_of(network, bond));
    }
    const ExpectedCrack crack = planes.weakest();
    if (crack.energy < least.energy) least = crack;
  }
  if (std::isinf(least.energy)) return {};
  return least;
}

double expected_batch(double events, double tolerance, int dim) {
  const double abreast = dim == 2 ? 4.0 * std::sqrt(events) : 1.6 * std::pow(events, 2.0 / 3.0);
  return std::max(1.0, tolerance * abreast);
}

}  // namespace perilink
