#include "assembly/element_vector.hpp"

#include <cmath>

#include "network/frame.hpp"

namespace perilink {
namespace {

template <int Dim>
ElementVectors frame_vectors(const Network& network, const Unknowns& unknowns, Index element,
                             double fraction) {
  using Modes = FrameModes<Dim>;
  const Modes modes = frame_modes<Dim>(network, element);
  const Index ends[2] = {network.bonds.first[element], network.bonds.second[element]};
  ElementVectors result;
  for (int m = 0; m < Modes::count; ++m) {
    if (!(modes.stiffness[m] > 0.0)) continue;
    const double root = std::sqrt(modes.stiffness[m] * fraction);
    SparseVector& x = result.x[result.count];
    for (int end = 0; end < 2; ++end) {
      const auto& b = end == 0 ? modes.first[m] : modes.second[m];
      const std::size_t slot = static_cast<std::size_t>(ends[end]) * Modes::width;
      for (int a = 0; a < Modes::width; ++a) {
        if (b[a] == 0.0) continue;
        result.prescribed[result.count] += root * b[a] * unknowns.prescribed[slot + a];
        unknowns.for_each(slot + a, [&](Index unknown, double weight) {
          x.add(unknown, weight * (root * b[a]));
        });
      }
    }
    ++result.count;
  }
  return result;
}

}  // namespace

SparseVector element_vector(const Network& network, const Unknowns& unknowns, Index element,
                            double stiffness) {
  SparseVector x;
  const double root = std::sqrt(stiffness);
  const std::span<const double> n = network.bonds.direction(element);
  const Index ends[2] = {network.bonds.first[element], network.bonds.second[element]};
  for (int end = 0; end < 2; ++end) {
    const std::size_t slot = static_cast<std::size_t>(ends[end]) * unknowns.width;
    for (int a = 0; a < network.dim(); ++a) {
      if (n[a] == 0.0) continue;
      unknowns.for_each(slot + a, [&](Index unknown, double weight) {
        x.add(unknown, weight * ((end == 0 ? -root : root) * n[a]));
      });
    }
  }
  return x;
}

ElementVectors axial_vector(const Network& network, const Unknowns& unknowns, Index element,
                            double fraction) {
  const double stiffness = network.stiffness[element] * fraction;
  const double root = std::sqrt(stiffness);
  const std::span<const double> n = network.bonds.direction(element);
  const std::size_t i = static_cast<std::size_t>(network.bonds.first[element]) * unknowns.width;
  const std::size_t j = static_cast<std::size_t>(network.bonds.second[element]) * unknowns.width;
  ElementVectors result;
  result.count = 1;
  result.x[0] = element_vector(network, unknowns, element, stiffness);
  for (int a = 0; a < network.dim(); ++a) {
    result.prescribed[0] += root * n[a] * (unknowns.prescribed[j + a] - unknowns.prescribed[i + a]);
  }
  return result;
}

ElementVectors element_vectors(const Network& network, const Unknowns& unknowns, Index element,
                               double fraction) {
  if (!network.carries_moments() || !(network.bending[element] > 0.0)) {
    return axial_vector(network, unknowns, element, fraction);
  }
  return network.dim() == 2 ? frame_vectors<2>(network, unknowns, element, fraction)
                            : frame_vectors<3>(network, unknowns, element, fraction);
}

}  // namespace perilink
