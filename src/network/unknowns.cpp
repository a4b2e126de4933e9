#include "network/unknowns.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace perilink {

std::vector<double> Unknowns::expand(std::span<const double> q) const {
  std::vector<double> displacement = prescribed;
  for (std::size_t slot = 0; slot < number.size(); ++slot) {
    for_each(slot, [&](Index k, double weight) { displacement[slot] += weight * q[k]; });
  }
  return displacement;
}

void Unknowns::expand(std::span<const double> q, std::span<const std::size_t> slots,
                      std::span<double> displacement) const {
  for (const std::size_t slot : slots) {
    double u = prescribed[slot];
    for_each(slot, [&](Index k, double weight) { u += weight * q[k]; });
    displacement[slot] = u;
  }
}

std::vector<double> Unknowns::restrict(std::span<const double> forces) const {
  std::vector<double> result(static_cast<std::size_t>(count), 0.0);
  for (std::size_t slot = 0; slot < number.size(); ++slot) {
    for_each(slot, [&](Index k, double weight) { result[k] += weight * forces[slot]; });
  }
  return result;
}

std::vector<std::size_t> Unknowns::slots() const {
  std::vector<std::size_t> result(static_cast<std::size_t>(count), number.size());
  for (std::size_t slot = 0; slot < number.size(); ++slot) {
    for_each(slot, [&](Index k, double) {
      if (number[slot] == k || result[k] == number.size()) result[k] = slot;
    });
  }
  return result;
}

std::vector<Index> Unknowns::owners() const {
  std::vector<Index> owners;
  for (const std::size_t slot : slots()) {
    owners.push_back(static_cast<Index>(slot / static_cast<std::size_t>(width)));
  }
  std::copy(nodes_.begin(), nodes_.end(),
            owners.end() - static_cast<std::ptrdiff_t>(nodes_.size()));
  return owners;
}

void expect_nothing_embedded(const Unknowns& unknowns) {
  if (unknowns.carries()) throw std::invalid_argument("embedded particles are not supported here");
}

Unknowns number_unknowns(int width, const std::vector<std::uint8_t>& held,
                         std::vector<double> prescribed) {
  Unknowns unknowns;
  unknowns.width = width;
  unknowns.prescribed = std::move(prescribed);
  unknowns.number.resize(held.size());
  for (std::size_t slot = 0; slot < held.size(); ++slot) {
    unknowns.number[slot] = held[slot] ? no_index : unknowns.count++;
  }
  return unknowns;
}

namespace {

/// Returns the number of components in which an embedded point follows its particles; it follows
/// rotations only of a single particle.
int following(const Network& network, Index embedded_point) {
  return network.embedded_points.particles.row(embedded_point).size() == 1 ? network.width()
                                                                           : network.dim();
}

/// Calls visit(slot, weight) for the slots that move a component of an embedded point.
template <class Visit>
void for_each_weight(const Network& network, Index embedded_point, int component, Visit visit) {
  const auto width = static_cast<std::size_t>(network.width());
  network.embedded_points.for_each_weight(
      embedded_point, component, network.dim(), [&](Index particle, int own, double weight) {
        visit(static_cast<std::size_t>(particle) * width + own, weight);
      });
}

template <class Visit>
void for_each_embedded_slot(const Network& network, Visit visit) {
  const auto width = static_cast<std::size_t>(network.width());
  for (Index k = 0; k < network.embedded_points.size(); ++k) {
    const std::size_t slot = static_cast<std::size_t>(network.first_embedded_point() + k) * width;
    for (int a = 0; a < following(network, k); ++a) visit(k, slot + a, a);
  }
}

}  // namespace

void hold_embedded_points(const Network& network, std::vector<std::uint8_t>& held) {
  const std::size_t first =
      static_cast<std::size_t>(network.first_embedded_point()) * network.width();
  std::fill(held.begin() + static_cast<std::ptrdiff_t>(first), held.end(), 1);
}

void carry_embedded_points(const Network& network, Unknowns& unknowns) {
  std::vector<Unknowns::Share> shares;
  for_each_embedded_slot(network, [&](Index k, std::size_t slot, int component) {
    shares.clear();
    for_each_weight(network, k, component, [&](std::size_t own, double weight) {
      if (unknowns.number[own] >= 0) shares.push_back({unknowns.number[own], weight});
      unknowns.prescribed[slot] += weight * unknowns.prescribed[own];
    });
    if (!shares.empty()) unknowns.carry(slot, shares);
  });
}

void follow_particles(const Network& network, std::span<double> motion) {
  for_each_embedded_slot(network, [&](Index k, std::size_t slot, int component) {
    motion[slot] = 0.0;
    for_each_weight(network, k, component,
                    [&](std::size_t own, double weight) { motion[slot] += weight * motion[own]; });
  });
}

void load_particles(const Network& network, std::span<double> forces) {
  for_each_embedded_slot(network, [&](Index k, std::size_t slot, int component) {
    for_each_weight(network, k, component,
                    [&](std::size_t own, double weight) { forces[own] += weight * forces[slot]; });
    forces[slot] = 0.0;
  });
}

std::vector<std::uint8_t> rotating_particles(const Network& network) {
  if (!network.carries_moments()) return {};
  std::vector<std::uint8_t> rotating(static_cast<std::size_t>(network.particles.size()));
  for (Index e = 0; e < network.num_elements(); ++e) {
    if (!(network.bending[e] > 0.0)) continue;
    const int hinged = network.hinged.empty() ? 0 : network.hinged[e];
    if ((hinged & first_end) == 0) rotating[network.bonds.first[e]] = 1;
    if ((hinged & second_end) == 0) rotating[network.bonds.second[e]] = 1;
  }
  return rotating;
}

namespace {

/// In space a straight bar that bends turns freely about its axis. Marks one rotation of its first
/// node as held; this causes no strain, since the whole bar turns.
void hold_twist_of_bars(const Network& network, std::vector<std::uint8_t>& held) {
  constexpr double straight = 1.0 - 1e-9;  // least cosine between bar elements
  const std::vector<Index>& bar = network.bars.bar;
  if (network.dim() < 3 || !network.carries_moments()) return;
  for (std::size_t begin = 0, end = 0; begin < bar.size(); begin = end) {
    const Index first = network.first_bar_element + static_cast<Index>(begin);
    const auto n = network.bonds.direction(first);
    bool turns = network.bending[first] > 0.0;
    for (end = begin; end == begin || network.bars.continues(end); ++end) {
      const auto m = network.bonds.direction(network.first_bar_element + static_cast<Index>(end));
      turns = turns && std::abs(n[0] * m[0] + n[1] * m[1] + n[2] * m[2]) > straight;
    }
    if (!turns) continue;
    const auto most = std::max_element(
        n.begin(), n.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
    const auto node = static_cast<std::size_t>(network.bonds.first[first]);
    held[node * network.width() + 3 + static_cast<std::size_t>(most - n.begin())] = 1;
  }
}

}  // namespace

double largest_displacement(const Network& network, std::span<const double> motion) {
  const auto width = static_cast<std::size_t>(network.width());
  const auto dim = static_cast<std::size_t>(network.dim());
  double largest = 0.0;
  for (std::size_t begin = 0; begin < motion.size(); begin += width) {
    for (std::size_t slot = begin; slot < begin + dim; ++slot) {
      largest = std::max(largest, std::abs(motion[slot]));
    }
  }
  return largest;
}

void hold_idle_rotations(const Network& network, std::vector<std::uint8_t>& held) {
  const std::vector<std::uint8_t> rotating = rotating_particles(network);
  const std::size_t width = network.width();
  for (std::size_t i = 0; i < rotating.size(); ++i) {
    for (std::size_t a = network.dim(); a < width && !rotating[i]; ++a) held[i * width + a] = 1;
  }
  hold_twist_of_bars(network, held);
}

}  // namespace perilink
