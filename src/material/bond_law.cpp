#include "material/bond_law.hpp"

#include <cmath>
#include <cstdlib>
#include <limits>
#include <stdexcept>

namespace perilink {
namespace {

void check_segments(const std::vector<Segment>& segments) {
  Segment last{2.0, 0.0};
  for (const Segment& segment : segments) {
    const bool falls = segment.secant > 0.0 && segment.secant < last.secant;
    if (!falls || !(segment.limit > last.limit)) {
      throw std::invalid_argument("secants of a saw-tooth law must fall and its limits must rise");
    }
    last = segment;
  }
  if (segments.empty() || segments.front().secant != 1.0) {
    throw std::invalid_argument("the first secant of a saw-tooth law must be one");
  }
}

}  // namespace

BondLaw BondLaw::brittle() { return {Sense::tension, {{1.0, 1.0}}, 0.0}; }

BondLaw BondLaw::plateau(double ratio) {
  if (!(ratio > 1.0)) throw std::invalid_argument("a plateau needs a ratio above one");
  return {Sense::both, {{1.0, std::sqrt(ratio)}}, ratio};
}

BondLaw BondLaw::both_ways(std::vector<Segment> segments, double ratio) {
  check_segments(segments);
  if (ratio != 0.0 && !(ratio > 1.0)) {
    throw std::invalid_argument("a plateau needs a ratio above one");
  }
  return {Sense::both, std::move(segments), ratio};
}

BondLaw BondLaw::saw_tooth(std::vector<Segment> segments) {
  check_segments(segments);
  return {Sense::tension, std::move(segments), 0.0};
}

BondLaw BondLaw::closing() const {
  BondLaw law = *this;
  law.closes_ = true;
  return law;
}

BondLaw BondLaw::crushing(std::vector<Segment> segments, double scale, bool keeps_shear) const {
  check_segments(segments);
  if (!(scale > 0.0) || endless() || closes_) {
    throw std::invalid_argument("a law with a compressive branch may neither yield nor close");
  }
  for (Segment& segment : segments) segment.limit *= scale;
  BondLaw law = *this;
  law.sense_ = Sense::each;
  law.crushing_ = std::move(segments);
  law.keeps_shear_ = keeps_shear;
  return law;
}

Segment BondLaw::first_in_compression() const { return crushing_.front(); }

Segment BondLaw::segment(int k) const {
  const std::vector<Segment>& branch = k < 0 ? crushing_ : segments_;
  const auto place = static_cast<std::size_t>(std::abs(k));
  if (place < branch.size()) return branch[place];
  if (endless() && k > 0) {
    const double growth = std::pow(ratio_, k + 1 - static_cast<int>(segments_.size()));
    return {segments_.back().secant / growth, segments_.back().limit * growth};
  }
  return {0.0, std::numeric_limits<double>::infinity()};
}

}  // namespace perilink
