#include "network/free_bodies.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/joined_parts.hpp"

namespace perilink {
namespace {

/// Least-squares parts of the rigid-body motions of a fragment in a field: those for which the sum
/// over slots of weight (field - motion)^2 is smallest, with weight times field given.
/// \param weight  of a slot
Eigen::VectorXd parts_of(const std::vector<std::vector<double>>& motions,
                         const std::vector<double>& weighted_field, const auto& weight) {
  const auto count = static_cast<Eigen::Index>(motions.size());
  Eigen::MatrixXd products = Eigen::MatrixXd::Zero(count, count);
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(count);
  for (std::size_t slot = 0; slot < weighted_field.size(); ++slot) {
    for (Eigen::Index m = 0; m < count; ++m) {
      sums[m] += motions[m][slot] * weighted_field[slot];
      for (Eigen::Index n = 0; n < count; ++n) {
        products(m, n) += weight(slot) * motions[m][slot] * motions[n][slot];
      }
    }
  }
  return products.completeOrthogonalDecomposition().solve(sums);
}

/// The sum of motions times their parts at a slot.
double motion_at(const std::vector<std::vector<double>>& motions, const Eigen::VectorXd& parts,
                 std::size_t slot) {
  double sum = 0.0;
  for (std::size_t m = 0; m < motions.size(); ++m) {
    sum += parts[static_cast<Eigen::Index>(m)] * motions[m][slot];
  }
  return sum;
}

std::vector<std::vector<double>> rigid_motions(const Network& network, const Fragment& fragment) {
  const auto width = static_cast<std::size_t>(network.width());
  std::vector<std::uint8_t> held(width * static_cast<std::size_t>(network.particles.size()), 0);
  return free_motions(network, fragment, held);
}

}  // namespace

std::vector<Fragment> connected_parts(const Network& network, Secants secants, bool in_one_piece) {
  const Index num_particles = network.particles.size();
  JoinedParts parts(num_particles);
  for (Index i = 1; in_one_piece && i < num_particles; ++i) parts.join(0, i);
  for (Index e = 0; e < network.num_elements(); ++e) {
    if (!(network.stiffness[e] > 0.0) || secants[e] == 0.0) continue;
    parts.join(network.bonds.first[e], network.bonds.second[e]);
  }
  for (Index k = 0; network.cells && k < network.cells->cells.size(); ++k) {
    const auto cell = network.cells->cells.cell(k);
    for (const Index vertex : cell) parts.join(cell.front(), vertex);
  }
  for (Index k = 0; k < network.anchors.size(); ++k) {
    for (const Index i : network.anchors.particles.row(k)) {
      parts.join(network.first_anchor() + k, i);
    }
  }
  std::vector<Fragment> fragments;
  std::vector<Index> fragment_of_root(static_cast<std::size_t>(num_particles), no_index);
  for (Index i = 0; i < num_particles; ++i) {
    Index& number = fragment_of_root[parts.find(i)];
    if (number == no_index) {
      number = static_cast<Index>(fragments.size());
      fragments.emplace_back();
    }
    fragments[number].particles.push_back(i);
  }
  return fragments;
}

std::vector<std::uint8_t> held_components(const Network& network, const Unknowns& unknowns) {
  std::vector<std::uint8_t> held;
  for (std::size_t slot = 0; slot < unknowns.number.size(); ++slot) {
    const bool is_anchor = network.is_anchor(static_cast<Index>(slot / unknowns.width));
    held.push_back(unknowns.number[slot] == no_index && !is_anchor);
  }
  return held;
}

std::vector<std::uint8_t> held_or_sprung(const Network& network, std::vector<std::uint8_t> held) {
  for (std::size_t slot = 0; slot < network.support_stiffness.size(); ++slot) {
    if (network.support_stiffness[slot] > 0.0) held[slot] = 1;
  }
  return held;
}

std::vector<std::vector<double>> free_motions(const Network& network, const Unknowns& unknowns) {
  const std::vector<std::uint8_t> held =
      held_or_sprung(network, held_components(network, unknowns));
  std::vector<std::vector<double>> motions;
  for (const Fragment& fragment : find_fragments(network, held)) {
    if (fragment.free_modes == 0) continue;
    for (auto& motion : free_motions(network, fragment, held)) {
      motions.push_back(std::move(motion));
    }
  }
  return motions;
}

double strained_motion(const Network& network, const Fragment& fragment,
                       const std::vector<std::uint8_t>& held,
                       const std::vector<double>& prescribed) {
  const auto width = static_cast<std::size_t>(network.width());
  const auto for_each_held = [&](const auto& visit) {
    for (const Index i : fragment.particles) {
      for (std::size_t slot = i * width; slot < (i + 1) * width; ++slot) {
        if (held[slot] != 0) visit(slot);
      }
    }
  };
  bool is_held = false;
  for_each_held([&](std::size_t) { is_held = true; });
  if (!is_held) return 0.0;
  const auto motions = rigid_motions(network, fragment);
  std::vector<double> field(held.size(), 0.0);
  for_each_held([&](std::size_t slot) { field[slot] = prescribed[slot]; });
  const Eigen::VectorXd parts =
      parts_of(motions, field, [&](std::size_t slot) { return held[slot] != 0 ? 1.0 : 0.0; });
  double largest = 0.0;
  for_each_held([&](std::size_t slot) {
    largest = std::max(largest, std::abs(motion_at(motions, parts, slot) - prescribed[slot]));
  });
  return largest;
}

void balance_loads(const Network& network, const Fragment& fragment, std::span<const double> mass,
                   Loads& loads) {
  auto motions = rigid_motions(network, fragment);
  const std::size_t first = static_cast<std::size_t>(network.first_anchor()) * network.width();
  for (std::vector<double>& motion : motions) {
    if (first < motion.size()) {
      std::fill(motion.begin() + static_cast<std::ptrdiff_t>(first), motion.end(), 0.0);
    }
  }
  const Eigen::VectorXd parts =
      parts_of(motions, loads.forces, [&](std::size_t slot) { return mass[slot]; });
  for (std::size_t slot = 0; slot < mass.size(); ++slot) {
    loads.forces[slot] -= mass[slot] * motion_at(motions, parts, slot);
  }
}

}  // namespace perilink
