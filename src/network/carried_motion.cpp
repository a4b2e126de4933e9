#include "network/carried_motion.hpp"

#include <algorithm>

namespace perilink {
namespace {

/// A particle whose weight differs from one by less than this stands at the node.
constexpr double at_node = 1e-9;

std::size_t slot_of(const Unknowns& unknowns, Index particle, int component) {
  return static_cast<std::size_t>(particle) * unknowns.width + component;
}

/// Components of nodes at held particles, shape (nodes, width).
std::vector<std::uint8_t> held_at_nodes(const Carriers& carriers, const Unknowns& free) {
  std::vector<std::uint8_t> held(static_cast<std::size_t>(carriers.num_nodes()) * free.width, 0);
  for (Index e = 0; e < carriers.size(); ++e) {
    const auto nodes = carriers.nodes_of.row(e);
    const auto inside = carriers.inside.row(e);
    for (std::size_t k = 0; k < inside.size(); ++k) {
      const auto weights = carriers.weights_at(e, k);
      const auto largest = std::max_element(weights.begin(), weights.end());
      if (*largest < 1.0 - at_node) continue;
      const Index node = nodes[static_cast<std::size_t>(largest - weights.begin())];
      for (int a = 0; a < free.width; ++a) {
        if (free.at(inside[k], a) == no_index) held[slot_of(free, node, a)] = 1;
      }
    }
  }
  return held;
}

}  // namespace

std::vector<std::uint8_t> fit_supports(const Carriers& carriers, const Unknowns& free) {
  const std::vector<std::uint8_t> held = held_at_nodes(carriers, free);
  std::vector<std::uint8_t> fits(static_cast<std::size_t>(carriers.size()), 1);
  for (Index e = 0; e < carriers.size(); ++e) {
    const auto nodes = carriers.nodes_of.row(e);
    const auto inside = carriers.inside.row(e);
    for (std::size_t k = 0; k < inside.size(); ++k) {
      const auto weights = carriers.weights_at(e, k);
      for (int a = 0; a < free.width; ++a) {
        bool moves = false;
        for (std::size_t c = 0; c < nodes.size(); ++c) {
          moves |= weights[c] != 0.0 && held[slot_of(free, nodes[c], a)] == 0;
        }
        const bool particle_moves = free.at(inside[k], a) != no_index;
        const bool driven = free.prescribed[slot_of(free, inside[k], a)] != 0.0;
        if (driven || moves != particle_moves) fits[e] = 0;
      }
    }
  }
  return fits;
}

std::vector<Index> carrier_of_particles(const Carriers& carriers,
                                        std::span<const std::uint8_t> whole, Index num_particles) {
  std::vector<Index> carrier(static_cast<std::size_t>(num_particles), no_index);
  for (Index e = 0; e < carriers.size(); ++e) {
    if (whole[e] == 0) continue;
    for (const Index i : carriers.inside.row(e)) {
      if (carrier[i] == no_index) carrier[i] = e;
    }
  }
  return carrier;
}

Unknowns carried_motion(const Carriers& carriers, const Unknowns& free,
                        std::span<const std::uint8_t> whole) {
  const auto num_particles = static_cast<Index>(free.number.size()) / free.width;
  const std::vector<Index> carrier = carrier_of_particles(carriers, whole, num_particles);
  std::vector<std::uint8_t> held(free.number.size());
  for (std::size_t slot = 0; slot < held.size(); ++slot) {
    held[slot] = free.number[slot] == no_index || carrier[slot / free.width] != no_index ? 1 : 0;
  }
  Unknowns unknowns = number_unknowns(free.width, held, free.prescribed);
  const std::vector<std::uint8_t> node_held = held_at_nodes(carriers, free);
  std::vector<Index> number(node_held.size(), no_index);
  std::vector<Unknowns::Share> shares;
  for (Index e = 0; e < carriers.size(); ++e) {
    if (whole[e] == 0) continue;
    const auto nodes = carriers.nodes_of.row(e);
    const auto inside = carriers.inside.row(e);
    for (const Index node : nodes) {
      const std::size_t slot = slot_of(free, node, 0);
      const auto first = number.begin() + static_cast<std::ptrdiff_t>(slot);
      if (std::any_of(first, first + free.width, [](Index k) { return k != no_index; })) continue;
      for (int a = 0; a < free.width; ++a) {
        if (node_held[slot + a] == 0) number[slot + a] = unknowns.add_shared(num_particles + node);
      }
    }
    for (std::size_t k = 0; k < inside.size(); ++k) {
      if (carrier[inside[k]] != e) continue;
      const auto weights = carriers.weights_at(e, k);
      for (int a = 0; a < free.width; ++a) {
        shares.clear();
        for (std::size_t c = 0; c < nodes.size(); ++c) {
          const Index unknown = number[slot_of(free, nodes[c], a)];
          if (weights[c] != 0.0 && unknown != no_index) shares.push_back({unknown, weights[c]});
        }
        if (!shares.empty()) unknowns.carry(slot_of(free, inside[k], a), shares);
      }
    }
  }
  return unknowns;
}

}  // namespace perilink
