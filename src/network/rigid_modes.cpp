#include "network/rigid_modes.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/joined_parts.hpp"
#include "discretization/bonds.hpp"
#include "network/rigid_mode_rows.hpp"
#include "network/unknowns.hpp"

namespace perilink {
namespace {

/// Orthonormal rows that the held unknowns span.
class HeldSpan {
 public:
  ModeRow residual(ModeRow row) const {
    for (const ModeRow& direction : basis_) row -= direction.dot(row) * direction;
    return row;
  }
  void add(const ModeRow& row) {
    const ModeRow rest = residual(residual(row));  // twice: orthogonal to round-off
    if (rest.squaredNorm() > rank_tolerance * row.squaredNorm()) {
      basis_.push_back(rest.normalized());
    }
  }

 private:
  std::vector<ModeRow> basis_;
};

/// Particles none of whose elements can break.
std::vector<std::uint8_t> unbreakable_particles(const Network& network) {
  std::vector<std::uint8_t> unbreakable(static_cast<std::size_t>(network.particles.size()), 1);
  for (Index e = 0; e < network.num_elements(); ++e) {
    if (!network.can_break(e)) continue;
    unbreakable[network.bonds.first[e]] = 0;
    unbreakable[network.bonds.second[e]] = 0;
  }
  return unbreakable;
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

std::vector<std::uint8_t> held_or_sprung(const Network& network, std::vector<std::uint8_t> held) {
  for (std::size_t slot = 0; slot < network.support_stiffness.size(); ++slot) {
    if (network.support_stiffness[slot] > 0.0) held[slot] = 1;
  }
  return held;
}

std::vector<Fragment> find_fragments(const Network& network, const std::vector<std::uint8_t>& held,
                                     bool in_one_piece) {
  std::vector<Fragment> fragments = connected_parts(network, {}, in_one_piece);
  const std::vector<std::uint8_t> rotating = rotating_particles(network);
  const std::vector<std::uint8_t> resisted = held_or_sprung(network, held);
  for (Fragment& fragment : fragments) {
    const RigidModes modes(network, rotating, fragment.particles);
    const ModeProducts products(fragment.particles, modes, resisted);
    fragment.free_modes = rank(products.all) - rank(products.held);
  }
  return fragments;
}

std::vector<std::vector<double>> free_motions(const Network& network, const Fragment& fragment,
                                              const std::vector<std::uint8_t>& held) {
  const std::vector<std::uint8_t> rotating = rotating_particles(network);
  const RigidModes modes(network, rotating, fragment.particles);
  const ModeProducts products(fragment.particles, modes, held);
  const Eigen::SelfAdjointEigenSolver<Gram> solver(products.held);
  std::vector<std::vector<double>> motions;
  for (int m = 0; m < 6; ++m) {
    const ModeRow mode = solver.eigenvectors().col(m);
    if (solver.eigenvalues()[m] > rank_tolerance * products.held.trace()) continue;
    const double moved = mode.dot(products.all * mode);
    if (!(moved > rank_tolerance * products.all.trace())) continue;
    std::vector<double>& motion = motions.emplace_back(held.size(), 0.0);
    for (const Index i : fragment.particles) {
      for (int a = 0; a < modes.components(i); ++a) {
        const std::size_t slot = modes.slot(i, a);
        if (!held[slot]) motion[slot] = modes.unit_of(a) * modes.row(i, a).dot(mode);
      }
    }
  }
  return motions;
}

namespace {

/// Determinant of the sum of n n' over bonds, over the power of its trace, below which the bonds lie
/// in one line or plane.
constexpr double flat_determinant = 1e-10;

/// Rigid parts of a body with its pre-cracks open. A part grows from bonded particles, two in the
/// plane and three in space, by all that bonds in independent directions hold to it; a bond that
/// carries moments holds by itself. Particles that no part reaches are parts of their own.
class RigidParts {
 public:
  explicit RigidParts(const Network& network);

  const std::vector<std::vector<Index>>& parts() const { return parts_; }
  /// Whether what cannot come loose is the first part.
  bool begins_fixed() const { return begins_fixed_; }
  Index part_of(Index particle) const { return part_[particle]; }

  /// Calls visit(element, other end) for the bonds of a particle that are no open crack.
  template <class Visit>
  void for_each_bond(Index particle, Visit visit) const {
    for (const Index e : families_.row(particle)) {
      if (carries_[e]) visit(e, network_.bonds.other_end(e, particle));
    }
  }

 private:
  std::vector<Index> fixed_particles() const;
  std::vector<Index> free_neighbors(Index particle) const;
  bool grow(std::vector<Index> members, std::size_t fewest);
  void grow_from(Index particle);
  bool holds(Index particle) const;

  const Network& network_;
  Csr families_;
  std::vector<std::uint8_t> carries_;
  std::vector<std::vector<Index>> parts_;
  bool begins_fixed_ = false;
  std::vector<Index> part_;
  std::vector<Eigen::Matrix3d> directions_;  ///< sum of n n' over bonds to the growing part
  std::vector<Index> attempt_of_;            ///< in which that was summed
  Index attempt_ = 0;
};

RigidParts::RigidParts(const Network& network)
    : network_(network), families_(bonds_of_particles(network.bonds, network.particles.size())) {
  for (const double k : network.stiffness) carries_.push_back(k > 0.0);
  for (const Index e : network.cut_elements) carries_[e] = 0;
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
  for (Index i = network_.first_anchor(); i < network_.particles.size(); ++i) fixed.push_back(i);
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
  if (network_.carries_moments()) return true;
  const Eigen::Matrix3d& sum = directions_[particle];
  const double determinant =
      network_.dim() == 2 ? sum.topLeftCorner<2, 2>().determinant() : sum.determinant();
  return determinant > flat_determinant * std::pow(sum.trace(), network_.dim());
}

/// \return whether the part has got more than the fewest particles; else all is as it was
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
  if (network_.carries_moments()) {
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
  const std::vector<std::uint8_t> rotating = rotating_particles(network);
  const std::vector<std::uint8_t> resisted = held_or_sprung(network, held);
  std::vector<std::uint8_t> is_held(parts.size(), 0);
  if (rigid.begins_fixed()) is_held[0] = 1;
  const auto smaller = [](const auto& a, const auto& b) { return a.size() < b.size(); };
  is_held[std::ranges::max_element(parts, smaller) - parts.begin()] = 1;
  std::vector<Fragment> loose;
  const auto free_modes = [&](const std::vector<Index>& part, Index number) {
    const RigidModes modes(network, rotating, part);
    ModeProducts products(part, modes, resisted);
    for (const Index i : part) {
      rigid.for_each_bond(i, [&](Index e, Index other) {
        if (rigid.part_of(other) == number || !is_held[rigid.part_of(other)]) return;
        ModeRow row = ModeRow::Zero();
        for (int a = 0; a < network.dim(); ++a) {
          row += network.bonds.direction(e)[a] * modes.row(i, a);
        }
        products.held += row * row.transpose();
      });
    }
    return rank(products.all) - rank(products.held);
  };
  for (bool changed = true; std::exchange(changed, false);) {
    loose.clear();
    for (std::size_t k = 0; k < parts.size(); ++k) {
      if (is_held[k]) continue;
      const int free = free_modes(parts[k], static_cast<Index>(k));
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

LoadResultant load_resultant(const Network& network, const Loads& loads) {
  const Particles& particles = network.particles;
  const int dim = particles.dim;
  double volume = 0.0;
  Vector3 centroid{};
  for (Index i = 0; i < particles.size(); ++i) {
    if (particles.kind[i] != ParticleKind::solid) continue;
    volume += particles.volumes[i];
    for (int axis = 0; axis < dim; ++axis) {
      centroid[axis] += particles.volumes[i] * particles.position(i)[axis];
    }
  }
  if (volume > 0.0) {
    for (double& coordinate : centroid) coordinate /= volume;
  }
  Vector3 force{};
  Vector3 moment{};
  LoadResultant resultant;
  const int width = network.width();
  for (Index i = 0; i < particles.size(); ++i) {
    Vector3 arm{};
    Vector3 load{};
    const double* own = loads.forces.data() + static_cast<std::size_t>(i) * width;
    for (int axis = 0; axis < dim; ++axis) {
      arm[axis] = particles.position(i)[axis] - centroid[axis];
      load[axis] = own[axis];
      force[axis] += load[axis];
    }
    for (int a = dim; a < width; ++a) moment[dim == 2 ? 2 : a - dim] += own[a];
    for (int k = 0; k < 3; ++k) {
      const int next = (k + 1) % 3;
      const int last = (k + 2) % 3;
      moment[k] += arm[next] * load[last] - arm[last] * load[next];
    }
    resultant.scale += std::hypot(load[0], load[1], load[2]);
  }
  resultant.force.assign(force.begin(), force.begin() + dim);
  resultant.moment =
      dim == 2 ? std::vector<double>{moment[2]} : std::vector<double>(moment.begin(), moment.end());
  return resultant;
}

void pin_rigid_modes(const Network& network, const Fragment& fragment,
                     std::vector<std::uint8_t>& held) {
  const std::vector<std::uint8_t> rotating = rotating_particles(network);
  const RigidModes modes(network, rotating, fragment.particles);
  const ModeProducts products(fragment.particles, modes, held);
  const auto unbreakable = unbreakable_particles(network);
  HeldSpan span;
  for (const Index i : fragment.particles) {
    for (int a = 0; a < modes.components(i); ++a) {
      if (held[modes.slot(i, a)]) span.add(modes.row(i, a));
    }
  }
  // The unknown that the modes left free move most comes next; one of a particle that cannot be
  // torn off is taken unless its lever is a thousand times too short.
  constexpr double least_preferred = 1e-3;
  for (int missing = rank(products.all) - rank(products.held); missing > 0; --missing) {
    struct Best {
      double residual = 0.0;
      Index particle = no_index;
      int component = 0;
    };
    Best preferred;
    Best any;
    Best rotation;  // taken where no displacement is left, as along a line of particles
    for (const Index i : fragment.particles) {
      for (int a = 0; a < modes.components(i) && !network.is_anchor(i); ++a) {
        if (held[modes.slot(i, a)]) continue;
        const double residual = span.residual(modes.row(i, a)).norm();
        Best& best = a < modes.dim() ? any : rotation;
        if (residual > best.residual) best = {residual, i, a};
        if (a < modes.dim() && unbreakable[i] && residual > preferred.residual) {
          preferred = {residual, i, a};
        }
      }
    }
    const Best& best = preferred.residual > least_preferred ? preferred
                       : any.residual > rank_lever          ? any
                                                            : rotation;
    if (best.particle == no_index) return;
    held[modes.slot(best.particle, best.component)] = 1;
    span.add(modes.row(best.particle, best.component));
  }
}

}  // namespace perilink
