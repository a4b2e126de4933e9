#include "material/bond_law.hpp"

#include <cmath>
#include <cstdlib>
#include <limits>
#include <stdexcept>

namespace perilink {
namespace {

void check_teeth(const std::vector<Tooth>& teeth) {
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
}

}  // namespace

BondLaw BondLaw::brittle() { return {Sense::tension, {{1.0, 1.0}}, 0.0}; }

BondLaw BondLaw::plateau(double ratio) {
  if (!(ratio > 1.0)) throw std::invalid_argument("teeth of a plateau have a ratio above one");
  return {Sense::both, {{1.0, std::sqrt(ratio)}}, ratio};
}

BondLaw BondLaw::both_ways(std::vector<Tooth> teeth, double ratio) {
  check_teeth(teeth);
  if (ratio != 0.0 && !(ratio > 1.0)) {
    throw std::invalid_argument("teeth of a plateau have a ratio above one");
  }
  return {Sense::both, std::move(teeth), ratio};
}

BondLaw BondLaw::saw_tooth(std::vector<Tooth> teeth) {
  check_teeth(teeth);
  return {Sense::tension, std::move(teeth), 0.0};
}

BondLaw BondLaw::closing() const {
  BondLaw law = *this;
  law.closes_ = true;
  return law;
}

BondLaw BondLaw::crushing(std::vector<Tooth> teeth, double scale, bool keeps_shear) const {
  check_teeth(teeth);
  if (!(scale > 0.0) || endless() || closes_) {
    throw std::invalid_argument("bonds with teeth in compression neither yield nor close");
  }
  for (Tooth& tooth : teeth) tooth.limit *= scale;
  BondLaw law = *this;
  law.sense_ = Sense::each;
  law.crushing_ = std::move(teeth);
  law.keeps_shear_ = keeps_shear;
  return law;
}

Tooth BondLaw::first_in_compression() const { return crushing_.front(); }

Tooth BondLaw::tooth(int k) const {
  const std::vector<Tooth>& branch = k < 0 ? crushing_ : teeth_;
  const auto place = static_cast<std::size_t>(std::abs(k));
  if (place < branch.size()) return branch[place];
  if (endless() && k > 0) {
    const double growth = std::pow(ratio_, k + 1 - static_cast<int>(teeth_.size()));
    return {teeth_.back().secant / growth, teeth_.back().limit * growth};
  }
  return {0.0, std::numeric_limits<double>::infinity()};
}

}  // namespace perilink
