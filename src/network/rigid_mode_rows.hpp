#pragma once

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "network/network.hpp"

namespace perilink {

using ModeRow = Eigen::Matrix<double, 6, 1>;
using Gram = Eigen::Matrix<double, 6, 6>;

/// Smallest squared sine between rigid-body modes that counts as independent: a lever of 1e-6 of
/// the fragment's radius. Round-off leaves 1e-15.
inline constexpr double rank_tolerance = 1e-12;

/// The lever itself.
inline constexpr double rank_lever = 1e-6;

/// Components of the motion of one particle in the rigid-body modes of a fragment: translations,
/// then rotations about its centroid, scaled to about one at its rim. A particle's own rotation
/// counts as the displacement that it means at the rim. Unused entries are zero.
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

  /// Components that the modes move: displacements, and rotations where bonds turn the particle.
  int components(Index particle) const {
    return !rotating_.empty() && rotating_[particle] ? width_ : particles_.dim;
  }

  std::size_t slot(Index particle, int component) const {
    return static_cast<std::size_t>(particle) * width_ + component;
  }

  /// A component in its own unit, length or radian, per displacement at the rim.
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
    if (radius_ == 0.0) return modes;  // one particle does not move as it turns
    const Vector3 arm = arm_of(particle);
    // Rotation about axis k moves the next axis forward and the one after it backward.
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

inline int rank(const Gram& gram) {
  const ModeRow eigenvalues =
      Eigen::SelfAdjointEigenSolver<Gram>(gram, Eigen::EigenvaluesOnly).eigenvalues();
  const double least = rank_tolerance * gram.trace();
  return static_cast<int>((eigenvalues.array() > least).count());
}

/// Products of the rigid-body modes on all unknowns of a fragment, and on the held ones.
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

}  // namespace perilink
