#include "released.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace perilink::verification {
namespace {

/// Energy that the law of a bond takes until its secant has fallen to this one [energy].
double taken(const Network& network, Index bond, double secant) {
  const double limit = network.critical_stretch[bond];
  if (std::isinf(limit)) return 0.0;
  const BondLaw& law = network.law(bond);
  double sum = 0.0;
  for (int k = 0; law.tooth(k).secant > secant; ++k) {
    const Tooth tooth = law.tooth(k);
    sum += tooth.limit * tooth.limit * (tooth.secant - law.tooth(k + 1).secant);
  }
  const double extension = limit * network.bonds.lengths[bond];
  return 0.5 * network.stiffness[bond] * extension * extension * sum;
}

/// What a crack in the plane across x takes, if it breaks nothing else.
double cut_at(const Network& network, double x) {
  double sum = 0.0;
  for (Index b = 0; b < network.bonds.size(); ++b) {
    const double from = network.particles.position(network.bonds.first[b])[0] - x;
    const double to = network.particles.position(network.bonds.second[b])[0] - x;
    if (from * to < 0.0) sum += taken(network, b, 0.0);
  }
  return sum;
}

}  // namespace

Released released_of(const StepState& state, double middle, double spacing) {
  const Network& network = state.network;
  Released released;
  for (Index b = 0; b < network.bonds.size(); ++b) {
    (state.secants[b] > 0.0 ? released.softened : released.broken) +=
        taken(network, b, state.secants[b]);
  }
  released.cut = std::numeric_limits<double>::infinity();
  for (int k = -15; k < 16; k += 2) {  // not through particles
    released.cut = std::min(released.cut, cut_at(network, middle + spacing * k / 16.0));
  }
  return released;
}

}  // namespace perilink::verification
