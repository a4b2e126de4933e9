#include "network/carried_motion.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace perilink {
namespace {

/// Shares of motions below this are round-off.
constexpr double negligible = 1e-9;

std::size_t slot_of(const Unknowns& unknowns, Index particle, int component) {
  return static_cast<std::size_t>(particle) * unknowns.width + component;
}

/// Nodes of an element that its held particles hold along a component: the motion of one node alone
/// is a combination of the motions of these particles.
std::vector<std::uint8_t> nodes_held_by(const Carriers& carriers, Index element,
                                        const std::vector<std::size_t>& held_places) {
  const auto count = static_cast<Index>(carriers.nodes_of.row(element).size());
  Eigen::MatrixXd rows(count, static_cast<Index>(held_places.size()));
  for (Index k = 0; k < rows.cols(); ++k) {
    const auto weights = carriers.weights_at(element, held_places[k]);
    for (Index c = 0; c < count; ++c) rows(c, k) = weights[c];
  }
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> space(rows);
  space.setThreshold(negligible);
  const Eigen::MatrixXd all = space.householderQ();
  const auto basis = all.leftCols(space.rank());  // motions that would move held particles
  std::vector<std::uint8_t> held(static_cast<std::size_t>(count));
  for (Index c = 0; c < count; ++c) {
    const Eigen::VectorXd alone = Eigen::VectorXd::Unit(count, c);
    held[c] = (alone - basis * (basis.transpose() * alone)).norm() < negligible;
  }
  return held;
}

/// Components of nodes that supports hold, shape (nodes, width).
using HeldNodes = std::vector<std::uint8_t>;

HeldNodes none_held(const Carriers& carriers, const Unknowns& free) {
  return HeldNodes(static_cast<std::size_t>(carriers.num_nodes()) * free.width, 0);
}

/// Adds what the particles of an element hold.
void hold_nodes(const Carriers& carriers, const Unknowns& free, Index element, HeldNodes& held) {
  const auto nodes = carriers.nodes_of.row(element);
  const auto inside = carriers.inside.row(element);
  std::vector<std::size_t> places;
  for (int a = 0; a < free.width; ++a) {
    places.clear();
    for (std::size_t k = 0; k < inside.size(); ++k) {
      const std::size_t slot = slot_of(free, inside[k], a);
      if (free.number[slot] == no_index && free.prescribed[slot] == 0.0) places.push_back(k);
    }
    if (places.empty()) continue;
    const std::vector<std::uint8_t> own = nodes_held_by(carriers, element, places);
    for (std::size_t c = 0; c < nodes.size(); ++c) held[slot_of(free, nodes[c], a)] |= own[c];
  }
}

/// Whether all particles of an element are held, and the others move, as its nodes make them.
bool fits(const Carriers& carriers, const Unknowns& free, Index element, const HeldNodes& held) {
  const auto nodes = carriers.nodes_of.row(element);
  const auto inside = carriers.inside.row(element);
  for (std::size_t k = 0; k < inside.size(); ++k) {
    const auto weights = carriers.weights_at(element, k);
    for (int a = 0; a < free.width; ++a) {
      bool moves = false;
      for (std::size_t c = 0; c < nodes.size(); ++c) {
        moves |= std::abs(weights[c]) > negligible && held[slot_of(free, nodes[c], a)] == 0;
      }
      const bool particle_moves = free.at(inside[k], a) != no_index;
      const bool driven = free.prescribed[slot_of(free, inside[k], a)] != 0.0;
      if (driven || moves != particle_moves) return false;
    }
  }
  return true;
}

}  // namespace

std::vector<std::uint8_t> fit_supports(const Carriers& carriers, const Unknowns& free) {
  std::vector<std::uint8_t> fitting(static_cast<std::size_t>(carriers.size()), 0);
  HeldNodes own = none_held(carriers, free), held = own;
  for (Index e = 0; e < carriers.size(); ++e) {
    hold_nodes(carriers, free, e, own);
    fitting[e] = fits(carriers, free, e, own);
    // What an element holds that does not fit by itself counts for no other.
    for (const Index node : carriers.nodes_of.row(e)) {
      for (int a = 0; a < free.width; ++a) {
        const std::size_t slot = slot_of(free, node, a);
        if (fitting[e] != 0) held[slot] |= own[slot];
        own[slot] = 0;
      }
    }
  }
  for (Index e = 0; e < carriers.size(); ++e) {
    if (fitting[e] != 0) fitting[e] = fits(carriers, free, e, held);
  }
  return fitting;
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
  HeldNodes node_held = none_held(carriers, free);
  for (Index e = 0; e < carriers.size(); ++e) {
    if (whole[e] != 0) hold_nodes(carriers, free, e, node_held);
  }
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
