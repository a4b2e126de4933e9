#include "network/rigid_modes.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include <Eigen/Core>

#include "base/dense/decompositions.hpp"
#include "base/joined_parts.hpp"
#include "network/unknowns.hpp"

namespace perilink {
namespace {

using ModeRow = Eigen::Matrix<double, 6, 1>;
using Gram = Eigen::Matrix<double, 6, 6>;

/// Smallest squared sine between independent rigid-body modes: a lever of 1e-6 of the fragment's
/// radius. Round-off leaves 1e-15.
constexpr double rank_tolerance = 1e-12;

/// Smallest lever between independent rigid-body modes, the root of rank_tolerance.
constexpr double rank_lever = 1e-6;

/// Components of one particle's motion in the rigid-body modes of a fragment: translations, then
/// rotations about its centroid. Rotations are scaled to a displacement of about one at the rim; a
/// particle's own rotation too. Unused entries are zero.
class RigidModes {
 public:
  RigidModes(const Network& network, const std::vector<std::uint8_t>& rotating,
             const std::vector<Index>& members)
      : particles_(network.particles), rotating_(rotating), width_(network.width()) {
    const Particles& particles = network.particles;
    for (const Index i : members) {
      for (int axis = 0; axis < particles.dim; ++axis) {
        centroid_[axis] += particles.position(i)[axis] / static_cast<double>(members.size());
      }
    }
    for (const Index i : members) {
      const Vector3 arm = arm_of(i);
      radius_ = std::max(radius_, std::hypot(arm[0], arm[1], arm[2]));
    }
  }

  int dim() const { return particles_.dim; }

  /// Returns the number of components that the modes move: displacements, and rotations where bonds
  /// turn the particle.
  int components(Index particle) const {
    return !rotating_.empty() && rotating_[particle] ? width_ : particles_.dim;
  }

  std::size_t slot(Index particle, int component) const {
    return static_cast<std::size_t>(particle) * width_ + component;
  }

  /// Returns the unit of a component, length or radian, per displacement at the rim.
  double unit_of(int component) const {
    return component < particles_.dim || radius_ == 0.0 ? 1.0 : 1.0 / radius_;
  }

  ModeRow row(Index particle, int component) const {
    ModeRow modes = ModeRow::Zero();
    if (component >= particles_.dim) {
      modes[particles_.dim == 2 ? 5 : component] = 1.0;
      return modes;
    }
    const int axis = component;
    modes[axis] = 1.0;
    if (radius_ == 0.0) return modes;  // a single particle does not move as it turns
    const Vector3 arm = arm_of(particle);
    // Rotation about axis k moves the next axis forward and the one after that backward.
    for (int k = particles_.dim == 2 ? 2 : 0; k < 3; ++k) {
      if (axis == (k + 1) % 3) modes[3 + k] = -arm[(k + 2) % 3] / radius_;
      if (axis == (k + 2) % 3) modes[3 + k] = arm[(k + 1) % 3] / radius_;
    }
    return modes;
  }

 private:
  Vector3 arm_of(Index particle) const {
    Vector3 arm{};
    for (int axis = 0; axis < particles_.dim; ++axis) {
      arm[axis] = particles_.position(particle)[axis] - centroid_[axis];
    }
    return arm;
  }

  const Particles& particles_;
  const std::vector<std::uint8_t>& rotating_;
  int width_;
  Vector3 centroid_{};
  double radius_ = 0.0;
};

int rank(const Gram& gram) {
  const double least = rank_tolerance * gram.trace();
  return static_cast<int>((eigenvalues(Eigen::MatrixXd(gram)).array() > least).count());
}

/// Products of the rigid-body modes over all unknowns of a fragment, and over the held ones.
struct ModeProducts {
  Gram all = Gram::Zero(), held = Gram::Zero();

  ModeProducts(const std::vector<Index>& members, const RigidModes& modes,
               const std::vector<std::uint8_t>& is_held) {
    for (const Index i : members) {
      for (int a = 0; a < modes.components(i); ++a) {
        const ModeRow row = modes.row(i, a);
        all += row * row.transpose();
        if (is_held[modes.slot(i, a)]) held += row * row.transpose();
      }
    }
  }
};

/// Orthonormal basis of the rows of held unknowns.
class HeldSpan {
 public:
  ModeRow residual(ModeRow row) const {
    for (const ModeRow& direction : basis_) row -= direction.dot(row) * direction;
    return row;
  }
  void add(const ModeRow& row) {
    const ModeRow rest = residual(residual(row));  // twice, for orthogonality to round-off
    if (rest.squaredNorm() > rank_tolerance * row.squaredNorm()) {
      basis_.push_back(rest.normalized());
    }
  }

 private:
  std::vector<ModeRow> basis_;
};

/// Flags particles without a breakable element.
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

std::vector<Fragment> connected_parts(const Network& network, Secants secants) {
  const Index num_particles = network.particles.size();
  JoinedParts parts(num_particles);
  for (Index e = 0; e < network.num_elements(); ++e) {
    if (!(network.stiffness[e] > 0.0) || secants[e] == 0.0) continue;
    parts.join(network.bonds.first[e], network.bonds.second[e]);
  }
  for (Index k = 0; network.cells && k < network.cells->cells.size(); ++k) {
    const auto cell = network.cells->cells.cell(k);
    for (const Index vertex : cell) parts.join(cell.front(), vertex);
  }
  for (Index k = 0; k < network.embedded_points.size(); ++k) {
    for (const Index i : network.embedded_points.particles.row(k)) {
      parts.join(network.first_embedded_point() + k, i);
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

std::vector<Fragment> find_fragments(const Network& network,
                                     const std::vector<std::uint8_t>& held) {
  std::vector<Fragment> fragments = connected_parts(network, {});
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
  const Eigenvectors own = eigenvectors(products.held);
  std::vector<std::vector<double>> motions;
  for (int m = 0; m < 6; ++m) {
    const ModeRow mode = own.vectors.col(m);
    if (own.values[m] > rank_tolerance * products.held.trace()) continue;
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

int free_modes(const Network& network, const std::vector<Index>& particles,
               const std::vector<std::uint8_t>& held,
               std::span<const std::pair<Index, Index>> bonds) {
  const std::vector<std::uint8_t> rotating = rotating_particles(network);
  const RigidModes modes(network, rotating, particles);
  ModeProducts products(particles, modes, held);
  for (const auto& [particle, element] : bonds) {
    ModeRow row = ModeRow::Zero();
    for (int a = 0; a < network.dim(); ++a) {
      row += network.bonds.direction(element)[a] * modes.row(particle, a);
    }
    products.held += row * row.transpose();
  }
  return rank(products.all) - rank(products.held);
}

bool is_translation(const Network& network, const std::vector<std::uint8_t>& held,
                    std::span<const double> values) {
  const auto width = static_cast<std::size_t>(network.width());
  std::vector<std::optional<double>> shift(width);
  for (std::size_t a = network.dim(); a < width; ++a) shift[a] = 0.0;  // no rotation
  for (std::size_t slot = 0; slot < values.size(); ++slot) {
    if (!held[slot]) continue;
    std::optional<double>& known = shift[slot % width];
    if (!known) known = values[slot];
    if (*known != values[slot]) return false;
  }
  return true;
}

bool is_rigid_motion(const Network& network, const std::vector<std::uint8_t>& held,
                     std::span<const double> values) {
  std::vector<Index> all(network.particles.size());
  std::iota(all.begin(), all.end(), 0);
  const std::vector<std::uint8_t> rotating = rotating_particles(network);
  const RigidModes modes(network, rotating, all);
  const auto for_each_held = [&](const auto& visit) {
    for (const Index i : all) {
      for (int a = 0; a < modes.components(i); ++a) {
        const std::size_t slot = modes.slot(i, a);
        if (held[slot]) visit(modes.row(i, a), values[slot] / modes.unit_of(a));
      }
    }
  };
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(6, 6);
  Eigen::VectorXd moved = Eigen::VectorXd::Zero(6);
  for_each_held([&](const ModeRow& row, double value) {
    gram += row * row.transpose();
    moved += value * row;
  });
  const Eigen::VectorXd motion = least_squares(gram, moved, rank_tolerance);
  double largest = 0.0, rest = 0.0;
  for_each_held([&](const ModeRow& row, double value) {
    largest = std::max(largest, std::abs(value));
    rest = std::max(rest, std::abs(value - row.dot(motion)));
  });
  return rest <= 1e-9 * largest;
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
  // The next unknown is the one with the largest motion in the free modes. A particle without
  // breakable bonds takes precedence unless its lever is a thousand times too short.
  constexpr double least_preferred = 1e-3;
  for (int missing = rank(products.all) - rank(products.held); missing > 0; --missing) {
    struct Best {
      double residual = 0.0;
      Index particle = no_index;
      int component = 0;
    };
    Best preferred;
    Best any;
    Best rotation;  // taken if no displacement is left, as along a line of particles
    for (const Index i : fragment.particles) {
      for (int a = 0; a < modes.components(i) && !network.is_embedded_point(i); ++a) {
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
