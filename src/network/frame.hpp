#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "network/network.hpp"

/// \file Micropolar bonds as frame elements. The energy of a bond of length xi between the
/// particles i and j is a sum of squares,
///
///   U = 1/2 sum over modes of k_m e_m^2,   e_m = b_first . q_i + b_second . q_j,
///
/// with a particle's displacements and rotations q. The unit vector n lies along the bond, t across
/// it, and u = u_j - u_i (Gerstle, Sau & Aguilera 2007, Eq. 5 in diagonal form):
///
///   axial    k                       e = u . n
///   shear    kb                      e = u . t - xi (a theta_i + (1 - a) theta_j)
///   bending  kb xi^2 / 12            e = theta_j - theta_i
///   torsion  torsion kb xi^2 / 12    e = (theta_j - theta_i) . n     (three dimensions)
///
/// a is one half in the paper. Calibrated bonds have their inflection elsewhere
/// (Network::inflection); hinged ones have no bending and no torsion (Network::hinged). In three
/// dimensions shear and bending occur twice, for the two directions across the bond. Rigid motions
/// with their rotations have no energy.
///
/// Bonds of shells have the depth t. Their stiffnesses against out-of-plane bending and torsion are
/// t^2/12 times k and kb. Their out-of-plane shear stiffness is Shell::shear_ratio times k
/// (docs/theory/shells.md).

namespace perilink {

/// Modes of one intact bond, with the components of Network::width().
template <int Dim>
struct FrameModes {
  static constexpr int width = Dim == 2 ? 3 : 6;
  static constexpr int count = width;

  std::array<double, count> stiffness;                    ///< k_m [force/length, force length]
  std::array<std::array<double, width>, count> first{};   ///< b of the first end
  std::array<std::array<double, width>, count> second{};  ///< b of the second end

  /// Returns e_m for the motions of the two ends, each of size width.
  template <class Real>
  Real deformation(int mode, const Real* first_end, const Real* second_end) const {
    Real sum = 0.0;
    for (int a = 0; a < width; ++a) {
      sum += first[mode][a] * first_end[a] + second[mode][a] * second_end[a];
    }
    return sum;
  }
};

/// Deformation of a bond without the vectors of its modes, for event searches and forces.
template <int Dim>
struct FrameDeformation {
  double extension = 0.0;
  double shear[Dim] = {};              ///< vector across n; in the plane the first entry is along t
  double bend[Dim == 2 ? 1 : 3] = {};  ///< relative rotation without its part about n
  double twist = 0.0;                  ///< relative rotation about n

  /// \param n                      unit vector from the first end to the second
  /// \param first_arm, second_arm  from each end to the inflection [length]
  /// \param i, j                   motions of the first end and the second
  [[gnu::always_inline]] FrameDeformation(const double* n, double first_arm, double second_arm,
                                          const double* i, const double* j) {
    if constexpr (Dim == 2) {
      const double dx = j[0] - i[0], dy = j[1] - i[1];
      extension = n[0] * dx + n[1] * dy;
      shear[0] = n[0] * dy - n[1] * dx - (first_arm * i[2] + second_arm * j[2]);
      bend[0] = j[2] - i[2];
    } else {
      double turn[3], arm[3];
      for (int a = 0; a < 3; ++a) {
        extension += n[a] * (j[a] - i[a]);
        turn[a] = j[3 + a] - i[3 + a];
        twist += n[a] * turn[a];
        arm[a] = first_arm * i[3 + a] + second_arm * j[3 + a];
      }
      for (int a = 0; a < 3; ++a) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        shear[a] = j[a] - i[a] - n[a] * extension + n[b] * arm[c] - n[c] * arm[b];
        bend[a] = turn[a] - n[a] * twist;
      }
    }
  }
};

namespace detail {

inline FrameModes<2> plane_modes(const double* n, double xi, double k, double kb,
                                 double inflection) {
  FrameModes<2> modes;
  modes.stiffness = {k, kb, kb * xi * xi / 12.0};
  modes.first[0] = {-n[0], -n[1], 0.0};
  modes.second[0] = {n[0], n[1], 0.0};
  modes.first[1] = {n[1], -n[0], -inflection * xi};
  modes.second[1] = {-n[1], n[0], -(1.0 - inflection) * xi};
  modes.first[2] = {0.0, 0.0, -1.0};
  modes.second[2] = {0.0, 0.0, 1.0};
  return modes;
}

/// Returns a unit vector normal to n, from the axis with the largest angle to n.
inline Vector3 across(const Vector3& n) {
  int axis = 0;
  for (int a = 1; a < 3; ++a) {
    if (std::abs(n[a]) < std::abs(n[axis])) axis = a;
  }
  Vector3 t{};
  t[axis] = 1.0;
  for (int a = 0; a < 3; ++a) t[a] -= n[axis] * n[a];
  const double length = std::sqrt(1.0 - n[axis] * n[axis]);
  for (double& component : t) component /= length;
  return t;
}

inline FrameModes<3> space_modes(const double* direction, double xi, double k, double kb,
                                 double torsion, double inflection) {
  const double bending = kb * xi * xi / 12.0;
  const Vector3 n{direction[0], direction[1], direction[2]};
  const Vector3 t1 = across(n);
  const Vector3 t2{n[1] * t1[2] - n[2] * t1[1], n[2] * t1[0] - n[0] * t1[2],
                   n[0] * t1[1] - n[1] * t1[0]};
  FrameModes<3> modes;
  modes.stiffness = {k, kb, kb, bending, bending, torsion * bending};
  for (int a = 0; a < 3; ++a) {
    // A rigid rotation w moves the second end by w x n xi: by xi w . t2 along t1, and by
    // -xi w . t1 along t2.
    const std::array<double, 3> translation{n[a], t1[a], t2[a]};
    for (int m = 0; m < 3; ++m) {
      modes.first[m][a] = -translation[m];
      modes.second[m][a] = translation[m];
    }
    modes.first[1][3 + a] = -inflection * xi * t2[a];
    modes.second[1][3 + a] = -(1.0 - inflection) * xi * t2[a];
    modes.first[2][3 + a] = inflection * xi * t1[a];
    modes.second[2][3 + a] = (1.0 - inflection) * xi * t1[a];
    const std::array<double, 3> rotation{t1[a], t2[a], n[a]};
    for (int m = 0; m < 3; ++m) {
      modes.first[3 + m][3 + a] = -rotation[m];
      modes.second[3 + m][3 + a] = rotation[m];
    }
  }
  return modes;
}

}  // namespace detail

namespace detail {

/// Returns the modes of a shell bond. t1 lies in the mid-surface, t2 = m is its normal. Axial force
/// and in-plane shear act at the mid-surface, `rise` above the bond.
inline FrameModes<3> shell_bond_modes(const Network& network, Index element, double xi, double k,
                                      double kb, double inflection) {
  const Shell& shell = *network.shell;
  const double* n = network.bonds.direction(element).data();
  const double* m = shell.normals.data() + static_cast<std::size_t>(element) * 3;
  const double square = shell.thickness * shell.thickness / 12.0;
  const double rise = shell.rise[element];
  FrameModes<3> modes;
  modes.stiffness = {
      k, kb, k * shell.shear_ratio[element], k * square, kb * xi * xi / 12.0, kb * square};
  for (int a = 0; a < 3; ++a) {
    const int b = (a + 1) % 3, c = (a + 2) % 3;
    const double t1 = m[b] * n[c] - m[c] * n[b];
    const std::array<double, 3> translation{n[a], t1, m[a]};
    const std::array<double, 3> rotation{t1, m[a], n[a]};
    for (int mode = 0; mode < 3; ++mode) {
      modes.first[mode][a] = -translation[mode];
      modes.second[mode][a] = translation[mode];
      modes.first[3 + mode][3 + a] = -rotation[mode];
      modes.second[3 + mode][3 + a] = rotation[mode];
    }
    modes.first[0][3 + a] = -rise * t1;
    modes.second[0][3 + a] = rise * t1;
    modes.first[1][3 + a] = rise * n[a] - inflection * xi * m[a];
    modes.second[1][3 + a] = -rise * n[a] - (1.0 - inflection) * xi * m[a];
    modes.first[2][3 + a] = modes.second[2][3 + a] = 0.5 * xi * t1;
  }
  return modes;
}

}  // namespace detail

/// Returns the modes of an element in a network that carries moments. Elements without bending
/// stiffness are trusses: only the axial mode has stiffness.
template <int Dim>
FrameModes<Dim> frame_modes(const Network& network, Index element) {
  const double* n = network.bonds.direction(element).data();
  const double xi = network.bonds.length(element);
  const double k = network.stiffness[element];
  const double kb = network.bending[element];
  const double inflection = network.inflection_of(element);
  FrameModes<Dim> modes;
  if constexpr (Dim == 2) {
    modes = detail::plane_modes(n, xi, k, kb, inflection);
  } else {
    if (network.shell) return detail::shell_bond_modes(network, element, xi, k, kb, inflection);
    modes = detail::space_modes(n, xi, k, kb, network.torsion, inflection);
  }
  if (network.is_hinged(element)) {
    std::fill(modes.stiffness.begin() + Dim, modes.stiffness.end(), 0.0);
  }
  return modes;
}

}  // namespace perilink
