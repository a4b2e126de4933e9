#include "network/builder/loose_parts.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "discretization/bonds.hpp"
#include "network/unknowns.hpp"

namespace perilink {
namespace {

/// Bonds lie in one line or plane where the determinant of the sum of n n' is below this times the
/// power of its trace.
constexpr double flat_determinant = 1e-10;

/// Rigid parts of a body with open pre-cracks. A part grows from bonded particles, two in the plane
/// and three in space. It takes particles that bonds in independent directions connect to it; one
/// bond suffices for particles that rotate. Each remaining particle is a part of its own.
class RigidParts {
 public:
  explicit RigidParts(const Network& network);

  const std::vector<std::vector<Index>>& parts() const { return parts_; }
  /// Returns whether the first part consists of fixed particles.
  bool begins_fixed() const { return begins_fixed_; }
  Index part_of(Index particle) const { return part_[particle]; }

  /// Calls visit(element, other end) for the bonds of a particle that do not cross an open crack.
  template <class Visit>
  void for_each_bond(Index particle, Visit visit) const {
    for (const Index e : neighbourhoods_.row(particle)) {
      if (carries_[e]) visit(e, network_.bonds.other_end(e, particle));
    }
  }

 private:
  std::vector<Index> fixed_particles() const;
  std::vector<Index> free_neighbors(Index particle) const;
  bool grow(std::vector<Index> members, std::size_t fewest);
  void grow_from(Index particle);
  bool holds(Index particle) const;
  bool rotates(Index particle) const { return !rotating_.empty() && rotating_[particle] != 0; }

  const Network& network_;
  std::vector<std::uint8_t> rotating_;  ///< see rotating_particles()
  Csr neighbourhoods_;
  std::vector<std::uint8_t> carries_;
  std::vector<std::vector<Index>> parts_;
  bool begins_fixed_ = false;
  std::vector<Index> part_;
  std::vector<Eigen::Matrix3d> directions_;  ///< sum of n n' over bonds to the growing part
  std::vector<Index> attempt_of_;            ///< attempt in which the sum was computed
  Index attempt_ = 0;
};

RigidParts::RigidParts(const Network& network)
    : network_(network),
      rotating_(rotating_particles(network)),
      neighbourhoods_(bonds_of_particles(network.bonds, network.particles.size())) {
  for (const double k : network.stiffness) carries_.push_back(k > 0.0);
  for (const Index e : network.contacts()) carries_[e] = 0;
  const auto count = static_cast<std::size_t>(network.particles.size());
  part_.assign(count, no_index);
  directions_.resize(count);
  attempt_of_.assign(count, 0);
  begins_fixed_ = grow(fixed_particles(), 1);
  for (Index i = 0; i < network.particles.size(); ++i) {
    if (part_[i] == no_index) grow_from(i);
  }
  for (Index i = 0; i < network.particles.size(); ++i) {
    if (part_[i] == no_index) grow({i}, 0);
  }
}

std::vector<Index> RigidParts::fixed_particles() const {
  std::vector<Index> fixed;
  for (Index i = network_.first_embedded_point(); i < network_.particles.size(); ++i)
    fixed.push_back(i);
  for (Index k = 0; network_.cells && k < network_.cells->cells.size(); ++k) {
    const auto cell = network_.cells->cells.cell(k);
    fixed.insert(fixed.end(), cell.begin(), cell.end());
  }
  std::sort(fixed.begin(), fixed.end());
  fixed.erase(std::unique(fixed.begin(), fixed.end()), fixed.end());
  return fixed;
}

std::vector<Index> RigidParts::free_neighbors(Index particle) const {
  std::vector<Index> neighbors;
  for_each_bond(particle, [&](Index, Index other) {
    if (part_[other] == no_index) neighbors.push_back(other);
  });
  return neighbors;
}

bool RigidParts::holds(Index particle) const {
  if (rotates(particle)) return true;
  const Eigen::Matrix3d& sum = directions_[particle];
  const double determinant =
      network_.dim() == 2 ? sum.topLeftCorner<2, 2>().determinant() : sum.determinant();
  return determinant > flat_determinant * std::pow(sum.trace(), network_.dim());
}

/// Grows a part from `members`.
/// \return whether it has more than `fewest` particles; otherwise no state changes
bool RigidParts::grow(std::vector<Index> members, std::size_t fewest) {
  const auto number = static_cast<Index>(parts_.size());
  ++attempt_;
  for (const Index i : members) part_[i] = number;
  for (std::size_t k = 0; k < members.size(); ++k) {
    for_each_bond(members[k], [&](Index e, Index other) {
      if (part_[other] != no_index) return;
      if (std::exchange(attempt_of_[other], attempt_) != attempt_) directions_[other].setZero();
      Eigen::Vector3d n = Eigen::Vector3d::Zero();
      for (int a = 0; a < network_.dim(); ++a) n[a] = network_.bonds.direction(e)[a];
      directions_[other] += n * n.transpose();
      if (!holds(other)) return;
      part_[other] = number;
      members.push_back(other);
    });
  }
  if (members.size() > fewest) {
    parts_.push_back(std::move(members));
    return true;
  }
  for (const Index i : members) part_[i] = no_index;
  return false;
}

void RigidParts::grow_from(Index particle) {
  if (rotates(particle)) {
    grow({particle}, 0);
    return;
  }
  const std::vector<Index> neighbors = free_neighbors(particle);
  for (const Index second : neighbors) {
    if (network_.dim() == 2) {
      if (grow({particle, second}, 2)) return;
      continue;
    }
    for (const Index third : free_neighbors(second)) {
      if (std::ranges::find(neighbors, third) == neighbors.end()) continue;
      if (grow({particle, second, third}, 3)) return;
    }
  }
}

}  // namespace

std::vector<Fragment> find_loose_parts(const Network& network,
                                       const std::vector<std::uint8_t>& held) {
  const RigidParts rigid(network);
  const std::vector<std::vector<Index>>& parts = rigid.parts();
  const std::vector<std::uint8_t> resisted = held_or_sprung(network, held);
  std::vector<std::uint8_t> is_held(parts.size(), 0);
  if (rigid.begins_fixed()) is_held[0] = 1;
  const auto smaller = [](const auto& a, const auto& b) { return a.size() < b.size(); };
  is_held[std::ranges::max_element(parts, smaller) - parts.begin()] = 1;
  std::vector<Fragment> loose;
  const auto free_of = [&](const std::vector<Index>& part, Index number) {
    std::vector<std::pair<Index, Index>> bonds;
    for (const Index i : part) {
      rigid.for_each_bond(i, [&](Index e, Index other) {
        const Index to = rigid.part_of(other);
        if (to != number && is_held[to] != 0) bonds.emplace_back(i, e);
      });
    }
    return free_modes(network, part, resisted, bonds);
  };
  for (bool changed = true; std::exchange(changed, false);) {
    loose.clear();
    for (std::size_t k = 0; k < parts.size(); ++k) {
      if (is_held[k]) continue;
      const int free = free_of(parts[k], static_cast<Index>(k));
      if (free > 0) {
        loose.push_back({parts[k], free});
      } else {
        is_held[k] = 1;
        changed = true;
      }
    }
  }
  return loose;
}

}  // namespace perilink
