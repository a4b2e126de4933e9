#include "released.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace perilink::verification {
namespace {

/// Bonds of a crack; before the peak none has lost so much.
constexpr double nearly_broken = 0.1;

/// Energy that the law of a bond takes until its secant has fallen to this one [energy].
double taken(const Network& network, Index bond, double secant) {
  const double limit = network.critical_stretch[bond];
  if (std::isinf(limit)) return 0.0;
  const BondLaw& law = network.law(bond);
  double sum = 0.0;
  for (int k = 0; law.segment(k).secant > secant; ++k) {
    const Segment segment = law.segment(k);
    sum += segment.limit * segment.limit * (segment.secant - law.segment(k + 1).secant);
  }
  const double extension = limit * network.bonds.lengths[bond];
  return 0.5 * network.stiffness[bond] * extension * extension * sum;
}

/// Energies of the bonds across a plane x = constant.
double across(const Network& network, const std::vector<double>& energy, double x) {
  double sum = 0.0;
  for (Index b = 0; b < network.bonds.size(); ++b) {
    const double from = network.particles.position(network.bonds.first[b])[0] - x;
    const double to = network.particles.position(network.bonds.second[b])[0] - x;
    if (from * to < 0.0) sum += energy[b];
  }
  return sum;
}

}  // namespace

Released released_of(const StepState& state, double middle, double spacing) {
  const Network& network = state.network;
  Released released{0.0, 0.0, std::numeric_limits<double>::infinity()};
  std::vector<double> in_all;
  for (Index b = 0; b < network.bonds.size(); ++b) {
    (state.secants[b] < nearly_broken ? released.crack : released.beside) +=
        taken(network, b, state.secants[b]);
    in_all.push_back(taken(network, b, 0.0));
  }
  for (int k = -8; k < 8; ++k) {  // not through particles
    const double x = middle + spacing * (k + 0.5) / 8.0;
    released.cut = std::min(released.cut, across(network, in_all, x));
  }
  return released;
}

}  // namespace perilink::verification
