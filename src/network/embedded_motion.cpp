#include "network/embedded_motion.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/dense/decompositions.hpp"
#include "discretization/facet_geometry.hpp"

namespace perilink {
namespace {

/// Coefficients of motions below this are round-off.
constexpr double negligible = 1e-9;

std::size_t slot_of(const Unknowns& unknowns, Index particle, int component) {
  return static_cast<std::size_t>(particle) * unknowns.width + component;
}

/// Returns coefficients that express the motion of each node along a component by the element's
/// held particles, shape (held particles, nodes). A column is zero where the held particles leave
/// the node free.
Eigen::MatrixXd shares_of_nodes(const Hosts& hosts, Index element,
                                const std::vector<std::size_t>& support_regions) {
  const auto count = static_cast<Index>(hosts.nodes_of.row(element).size());
  Eigen::MatrixXd rows(count, static_cast<Index>(support_regions.size()));
  for (Index k = 0; k < rows.cols(); ++k) {
    const auto weights = hosts.weights_at(element, support_regions[k]);
    for (Index c = 0; c < count; ++c) rows(c, k) = weights[c];
  }
  auto shares =
      least_squares<Eigen::MatrixXd>(rows, Eigen::MatrixXd::Identity(count, count), negligible);
  for (Index c = 0; c < count; ++c) {
    const Eigen::VectorXd alone = Eigen::VectorXd::Unit(count, c);
    if (!((rows * shares.col(c) - alone).norm() < negligible)) shares.col(c).setZero();
  }
  return shares;
}

/// Returns the vector from a node to a particle [length].
Vector3 arm_from(const Hosts& hosts, Index element, std::size_t place, Index node) {
  const auto nodes = hosts.nodes_of.row(element);
  const auto weights = hosts.weights_at(element, place);
  Vector3 arm{};
  for (int a = 0; a < hosts.dim; ++a) {
    const auto at = [&](Index n) {
      return hosts.nodes[static_cast<std::size_t>(n) * hosts.dim + a];
    };
    for (std::size_t c = 0; c < nodes.size(); ++c) arm[a] += weights[c] * (at(nodes[c]) - at(node));
  }
  return arm;
}

/// Returns whether the origin lies in the convex hull of some points or on its boundary, to a
/// tolerance. Uses von Neumann's algorithm on unit vectors to the points.
bool lies_among(std::vector<Vector3> ways) {
  constexpr double little = 0.05;
  constexpr int most_steps = 200;
  double farthest = 0.0;
  for (const Vector3& way : ways) farthest = std::max(farthest, norm(way));
  for (Vector3& way : ways) {
    const double length = norm(way);
    if (length <= negligible * farthest) return true;
    for (double& component : way) component /= length;
  }
  Vector3 mean = ways.front();
  for (int step = 0; step < most_steps && norm(mean) > little; ++step) {
    const Vector3& next = *std::min_element(
        ways.begin(), ways.end(),
        [&](const Vector3& x, const Vector3& y) { return dot(x, mean) < dot(y, mean); });
    const Vector3 change = minus(next, mean);
    const double gain = -dot(mean, change), length = dot(change, change);
    if (!(gain > negligible * length)) break;
    for (int a = 0; a < 3; ++a) mean[a] += std::min(1.0, gain / length) * change[a];
  }
  return norm(mean) <= little;
}

/// Components of nodes that supports hold, shape (nodes, width).
using HeldNodes = std::vector<std::uint8_t>;

HeldNodes none_held(const Hosts& hosts, const Unknowns& free) {
  return HeldNodes(static_cast<std::size_t>(hosts.num_nodes()) * free.width, 0);
}

/// Returns the positions within an element of the particles that supports hold along a component.
std::vector<std::size_t> support_regions(const Hosts& hosts, const Unknowns& free, Index element,
                                         int component) {
  const auto inside = hosts.inside.row(element);
  std::vector<std::size_t> places;
  for (std::size_t k = 0; k < inside.size(); ++k) {
    const std::size_t slot = slot_of(free, inside[k], component);
    if (free.number[slot] == no_index && free.prescribed[slot] == 0.0) places.push_back(k);
  }
  return places;
}

/// Marks the node components that the held particles of an element fix.
void hold_nodes(const Hosts& hosts, const Unknowns& free, Index element, HeldNodes& held) {
  const auto nodes = hosts.nodes_of.row(element);
  for (int a = 0; a < free.width; ++a) {
    const std::vector<std::size_t> places = support_regions(hosts, free, element, a);
    if (places.empty()) continue;
    const Eigen::MatrixXd shares = shares_of_nodes(hosts, element, places);
    for (std::size_t c = 0; c < nodes.size(); ++c) {
      if (!shares.col(static_cast<Index>(c)).isZero(0.0)) held[slot_of(free, nodes[c], a)] = 1;
    }
  }
}

/// Returns whether the nodes of an element hold and move its particles exactly as prescribed.
bool fits(const Hosts& hosts, const Unknowns& free, Index element, const HeldNodes& held) {
  const auto nodes = hosts.nodes_of.row(element);
  const auto inside = hosts.inside.row(element);
  for (std::size_t k = 0; k < inside.size(); ++k) {
    const auto weights = hosts.weights_at(element, k);
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

/// Marks node components that elements would hold outside the held particles, which would enlarge
/// the support.
HeldNodes held_beyond_supports(const Hosts& hosts, const Unknowns& free) {
  HeldNodes own = none_held(hosts, free), beyond = own;
  std::map<std::size_t, std::vector<Vector3>> arms;  // from held nodes to particles, by slot of the
                                                     // node
  for (Index e = 0; e < hosts.size(); ++e) {
    hold_nodes(hosts, free, e, own);
    for (const Index node : hosts.nodes_of.row(e)) {
      for (int a = 0; a < free.width; ++a) {
        const std::size_t slot = slot_of(free, node, a);
        if (own[slot] == 0) continue;
        own[slot] = 0;
        for (const std::size_t place : support_regions(hosts, free, e, a)) {
          arms[slot].push_back(arm_from(hosts, e, place, node));
        }
      }
    }
  }
  for (const auto& [slot, particles] : arms) beyond[slot] = lies_among(particles) ? 0 : 1;
  return beyond;
}

/// Returns whether an element has a node component with both marks.
bool shares_any(const Hosts& hosts, const Unknowns& free, Index element, const HeldNodes& first,
                const HeldNodes& second) {
  for (const Index node : hosts.nodes_of.row(element)) {
    for (int a = 0; a < free.width; ++a) {
      const std::size_t slot = slot_of(free, node, a);
      if (first[slot] != 0 && second[slot] != 0) return true;
    }
  }
  return false;
}

/// Re-expresses combinations of particles that are now embedded by the unknowns of their hosts.
void carry_followers(const Unknowns& free, Unknowns& unknowns) {
  if (!free.carries()) return;
  const std::vector<std::size_t> slots = free.slots();
  for (std::size_t slot = 0; slot < free.number.size(); ++slot) {
    if (!free.is_embedded(slot)) continue;
    std::map<Index, double> sums;
    free.for_each(slot, [&](Index own, double weight) {
      unknowns.for_each(slots[own], [&](Index k, double share) { sums[k] += weight * share; });
    });
    std::vector<Unknowns::Share> shares;
    for (const auto& [unknown, weight] : sums) shares.push_back({unknown, weight});
    if (!shares.empty()) unknowns.carry(slot, shares);
  }
}

}  // namespace

std::vector<std::uint8_t> fit_supports(const Hosts& hosts, const Unknowns& free) {
  std::vector<std::uint8_t> fitting(static_cast<std::size_t>(hosts.size()), 0);
  const HeldNodes beyond = held_beyond_supports(hosts, free);
  HeldNodes own = none_held(hosts, free), held = own;
  for (Index e = 0; e < hosts.size(); ++e) {
    hold_nodes(hosts, free, e, own);
    fitting[e] = fits(hosts, free, e, own) && !shares_any(hosts, free, e, own, beyond);
    // Only elements that fit by themselves hold nodes for other elements.
    for (const Index node : hosts.nodes_of.row(e)) {
      for (int a = 0; a < free.width; ++a) {
        const std::size_t slot = slot_of(free, node, a);
        if (fitting[e] != 0) held[slot] |= own[slot];
        own[slot] = 0;
      }
    }
  }
  for (Index e = 0; e < hosts.size(); ++e) {
    if (fitting[e] != 0) fitting[e] = fits(hosts, free, e, held);
  }
  return fitting;
}

std::vector<Index> host_of_particles(const Hosts& hosts, std::span<const std::uint8_t> whole,
                                     Index num_particles) {
  std::vector<Index> host(static_cast<std::size_t>(num_particles), no_index);
  for (Index e = 0; e < hosts.size(); ++e) {
    if (whole[e] == 0) continue;
    for (const Index i : hosts.inside.row(e)) {
      if (host[i] == no_index) host[i] = e;
    }
  }
  return host;
}

Unknowns embedded_motion(const Hosts& hosts, const Unknowns& free,
                         std::span<const std::uint8_t> whole) {
  const auto num_particles = static_cast<Index>(free.number.size()) / free.width;
  const std::vector<Index> host = host_of_particles(hosts, whole, num_particles);
  std::vector<std::uint8_t> held(free.number.size());
  for (std::size_t slot = 0; slot < held.size(); ++slot) {
    held[slot] = free.number[slot] < 0 || host[slot / free.width] != no_index ? 1 : 0;
  }
  Unknowns unknowns = number_unknowns(free.width, held, free.prescribed);
  HeldNodes node_held = none_held(hosts, free);
  for (Index e = 0; e < hosts.size(); ++e) {
    if (whole[e] != 0) hold_nodes(hosts, free, e, node_held);
  }
  std::vector<Index> number(node_held.size(), no_index);
  std::vector<Unknowns::Share> shares;
  for (Index e = 0; e < hosts.size(); ++e) {
    if (whole[e] == 0) continue;
    const auto nodes = hosts.nodes_of.row(e);
    const auto inside = hosts.inside.row(e);
    for (const Index node : nodes) {
      const std::size_t slot = slot_of(free, node, 0);
      const auto first = number.begin() + static_cast<std::ptrdiff_t>(slot);
      if (std::any_of(first, first + free.width, [](Index k) { return k != no_index; })) continue;
      for (int a = 0; a < free.width; ++a) {
        if (node_held[slot + a] == 0) number[slot + a] = unknowns.add_shared(num_particles + node);
      }
    }
    for (std::size_t k = 0; k < inside.size(); ++k) {
      if (host[inside[k]] != e) continue;
      const auto weights = hosts.weights_at(e, k);
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
  carry_followers(free, unknowns);
  return unknowns;
}

void pass_to_held(const Hosts& hosts, const Unknowns& free, std::span<const std::uint8_t> whole,
                  std::span<const double> loads, std::span<double> forces) {
  const std::vector<Index> host =
      host_of_particles(hosts, whole, static_cast<Index>(free.number.size()) / free.width);
  std::vector<double> at_nodes(none_held(hosts, free).size(), 0.0);
  for (std::size_t slot = 0; slot < forces.size(); ++slot) {
    const auto particle = static_cast<Index>(slot) / free.width;
    const Index e = host[particle];
    if (e == no_index || free.number[slot] < 0) continue;
    const auto nodes = hosts.nodes_of.row(e), inside = hosts.inside.row(e);
    const auto place = std::lower_bound(inside.begin(), inside.end(), particle) - inside.begin();
    const auto weights = hosts.weights_at(e, static_cast<std::size_t>(place));
    const int component = static_cast<int>(slot) % free.width;
    for (std::size_t c = 0; c < nodes.size(); ++c) {
      at_nodes[slot_of(free, nodes[c], component)] += weights[c] * (forces[slot] - loads[slot]);
    }
    forces[slot] = loads[slot];
  }
  for (Index e = 0; e < hosts.size(); ++e) {
    for (int a = 0; a < free.width && whole[e] != 0; ++a) {
      const std::vector<std::size_t> places = support_regions(hosts, free, e, a);
      if (places.empty()) continue;
      const Eigen::MatrixXd shares = shares_of_nodes(hosts, e, places);
      for (Index c = 0; c < shares.cols(); ++c) {
        double& at_node = at_nodes[slot_of(free, hosts.nodes_of.row(e)[c], a)];
        if (shares.col(c).isZero(0.0)) continue;
        for (std::size_t k = 0; k < places.size(); ++k) {
          const Index particle = hosts.inside.row(e)[places[k]];
          forces[slot_of(free, particle, a)] += shares(static_cast<Index>(k), c) * at_node;
        }
        at_node = 0.0;
      }
    }
  }
}

}  // namespace perilink
