#include "material/bond_law.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace perilink {

BondLaw BondLaw::brittle() { return {Sense::tension, {{1.0, 1.0}}, 0.0}; }

BondLaw BondLaw::plateau(double ratio) {
  if (!(ratio > 1.0)) throw std::invalid_argument("teeth of a plateau have a ratio above one");
  return {Sense::both, {}, ratio};
}

BondLaw BondLaw::saw_tooth(std::vector<Tooth> teeth) {
  Tooth last{2.0, 0.0};
  for (const Tooth& tooth : teeth) {
    const bool falls = tooth.secant > 0.0 && tooth.secant < last.secant;
    if (!falls || !(tooth.limit > last.limit)) {
      throw std::invalid_argument("secants of a saw-tooth law fall and its limits rise");
    }
    last = tooth;
  }
  if (teeth.empty() || teeth.front().secant != 1.0) {
    throw std::invalid_argument("the first secant of a saw-tooth law is one");
  }
  return {Sense::tension, std::move(teeth), 0.0};
}

BondLaw BondLaw::closing() const {
  BondLaw law = *this;
  law.closes_ = true;
  return law;
}

Tooth BondLaw::tooth(int k) const {
  if (endless()) {
    const double growth = std::pow(ratio_, k);
    return {1.0 / growth, std::sqrt(ratio_) * growth};
  }
  if (static_cast<std::size_t>(k) < teeth_.size()) return teeth_[static_cast<std::size_t>(k)];
  return {0.0, std::numeric_limits<double>::infinity()};
}

}  // namespace perilink
