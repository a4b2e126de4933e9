#pragma once

#include <cmath>

#include "network/frame.hpp"

/// \file
/// Directed bonds: half of an element at one of its ends. `own` and `far` are the motions of the
/// particle at this end and of the particle at the other end. Both halves measure deformation from
/// the first end to the second, so that both find identical numbers.

namespace perilink {

/// Half of an element with axial stiffness only, for small strains.
template <int Dim>
struct TrussHalf {
  static constexpr int width = Dim;

  double n[Dim];  ///< unit vector from the own end to the other
  double k;       ///< present stiffness [force/length]
  Index other;    ///< particle at the far end

  TrussHalf(const Network& network, Index element, bool first)
      : k(network.stiffness[element]),
        other(first ? network.bonds.second[element] : network.bonds.first[element]) {
    for (int a = 0; a < Dim; ++a) {
      n[a] = first ? network.bonds.direction(element)[a] : -network.bonds.direction(element)[a];
    }
  }

  static double limit_of_demand(double stretch, double length) { return stretch * length; }

  double extension(const double* own, const double* far) const {
    double sum = 0.0;
    for (int a = 0; a < Dim; ++a) sum += n[a] * (far[a] - own[a]);
    return sum;
  }

  /// Adds `sign` times the part of K u at the own end. \return the extension [length]
  double add_force(const double* own, const double* far, double* sum, double sign = 1.0) const {
    const double e = extension(own, far);
    for (int a = 0; a < Dim; ++a) sum[a] -= sign * k * e * n[a];
    return e;
  }

  /// Returns the measure of yielding of a bar, equal in tension and compression.
  double size(const double* own, const double* far) const { return std::abs(extension(own, far)); }

  /// q' K q_now / 2 of the whole element between two motions [force length].
  double energy(const double* own_before, const double* far_before, const double* own,
                const double* far) const {
    return 0.5 * k * extension(own_before, far_before) * extension(own, far);
  }

  /// Calls visit(modulus) for each stiffness that damage scales.
  template <class Visit>
  void for_stiffness(Visit visit) {
    visit(k);
  }

  bool is_compressed(const double* own, const double* far) const {
    return extension(own, far) < 0.0;
  }
  /// Returns the half with another axial stiffness and no other stiffness.
  TrussHalf axial_part(double stiffness) const {
    TrussHalf part = *this;
    part.k = stiffness;
    return part;
  }
};

/// Half of an element for finite stretches and rotations. X is the vector from the own end to the
/// other before loading, and x the present one. The energy is k |X|^2 g^2 / 2 of the Green–Lagrange
/// stretch g = (x.x - X.X) / (2 X.X) = s + s^2 / 2 (Miranda, Williams & Orr 2016, Eqs. 6 and 7).
/// Its derivative is the force k g x.
template <int Dim>
struct GreenHalf {
  static constexpr int width = Dim;

  double before[Dim];  ///< X [length]
  double flexibility;  ///< 1 / X.X [1/length^2]
  double k;            ///< present stiffness where g is small [force/length]
  Index other;         ///< particle at the far end

  GreenHalf(const Network& network, Index element, bool first)
      : k(network.stiffness[element]),
        other(first ? network.bonds.second[element] : network.bonds.first[element]) {
    const double length = network.bonds.length(element);
    flexibility = 1.0 / (length * length);
    for (int a = 0; a < Dim; ++a) {
      before[a] = (first ? length : -length) * network.bonds.direction(element)[a];
    }
  }

  static double limit_of_demand(double stretch, double /*length*/) { return stretch; }

  /// Returns g from the relative displacement d = x - X, because differences of lengths would
  /// cancel.
  double stretch(const double* own, const double* far) const {
    double sum = 0.0;
    for (int a = 0; a < Dim; ++a) {
      const double d = far[a] - own[a];
      sum += (before[a] + 0.5 * d) * d;
    }
    return flexibility * sum;
  }

  /// Adds `sign` times the internal force at the own end. \return the stretch g [-]
  double add_force(const double* own, const double* far, double* sum, double sign = 1.0) const {
    const double g = stretch(own, far);
    for (int a = 0; a < Dim; ++a) sum[a] -= sign * k * g * (before[a] + far[a] - own[a]);
    return g;
  }

  double size(const double* own, const double* far) const { return std::abs(stretch(own, far)); }

  /// Returns k |X|^2 g_before g_now / 2 between two motions [force length]. Euler–Cromer conserves
  /// it up to a fraction of the kinetic energy as small as the stretches.
  double energy(const double* own_before, const double* far_before, const double* own,
                const double* far) const {
    return 0.5 * k / flexibility * stretch(own_before, far_before) * stretch(own, far);
  }

  /// Calls visit(modulus) for each stiffness that damage scales.
  template <class Visit>
  void for_stiffness(Visit visit) {
    visit(k);
  }

  bool is_compressed(const double* own, const double* far) const { return stretch(own, far) < 0.0; }
  GreenHalf axial_part(double stiffness) const {
    GreenHalf part = *this;
    part.k = stiffness;
    return part;
  }
};

/// Half of a micropolar bond: a frame element with the modes of network/frame.hpp and the
/// equivalent stretch of analysis/quasistatic/events/frame_limit_search.hpp.
template <int Dim>
struct FrameHalf {
  static constexpr int width = Dim == 2 ? 3 : 6;

  double n[Dim];                   ///< unit vector from the first end to the second
  double first_arm, second_arm;    ///< from the ends to the inflection [length]
  double k, kb, rotational;        ///< stiffness: axial, transverse; rotational [force length]
  double twisting;                 ///< stiffness against relative rotations about n; in space
  double shear_share, bend_share;  ///< factors of squares in the equivalent stretch
  double twist_share;
  Index other;
  bool first;  ///< the own end is the first end

  FrameHalf(const Network& network, Index element, bool at_first)
      : k(network.stiffness[element]),
        kb(network.bending[element]),
        other(at_first ? network.bonds.second[element] : network.bonds.first[element]),
        first(at_first) {
    const double length = network.bonds.length(element);
    for (int a = 0; a < Dim; ++a) n[a] = network.bonds.direction(element)[a];
    first_arm = network.inflection_of(element) * length;
    second_arm = (1.0 - network.inflection_of(element)) * length;
    rotational = network.is_hinged(element) ? 0.0 : kb * length * length / 12.0;
    twisting = network.torsion * rotational;
    shear_share = network.ratio_of_bending(element);
    bend_share = network.is_hinged(element) ? 0.0 : shear_share * length * length / 12.0;
    twist_share = network.torsion * bend_share;
  }

  static double limit_of_demand(double stretch, double length) {
    return stretch * length * stretch * length;
  }

  using Deformation = FrameDeformation<Dim>;
  Deformation deformation(const double* own, const double* far) const {
    return {n, first_arm, second_arm, first ? own : far, first ? far : own};
  }

  /// Returns the square of equivalent stretch times length [length^2]; of bars, the square of the
  /// extension.
  static double square(const Deformation& d, double shear_share, double bend_share,
                       double twist_share) {
    double shear = 0.0, bend = 0.0;
    for (const double value : d.shear) shear += value * value;
    for (const double value : d.bend) bend += value * value;
    return d.extension * d.extension + shear_share * shear + bend_share * bend +
           twist_share * d.twist * d.twist;
  }

  /// Adds `sign` times the internal force at the own end. \return square() in tension, else zero
  double add_force(const double* own, const double* far, double* sum, double sign = 1.0) const {
    /// Without this threshold round-off would break bonds whose length symmetry preserves.
    constexpr double least_tension = 1e-12;
    const Deformation d = deformation(own, far);
    const double side = first ? -sign : sign;
    const double arm = first ? first_arm : second_arm;
    if constexpr (Dim == 2) {
      const double axial = side * k * d.extension, across = side * kb * d.shear[0];
      sum[0] += axial * n[0] - across * n[1];
      sum[1] += axial * n[1] + across * n[0];
      sum[2] += side * rotational * d.bend[0] - sign * kb * arm * d.shear[0];
    } else {
      for (int a = 0; a < 3; ++a) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        sum[a] += side * (k * d.extension * n[a] + kb * d.shear[a]);
        sum[3 + a] += side * (rotational * d.bend[a] + twisting * d.twist * n[a]) +
                      sign * kb * arm * (d.shear[b] * n[c] - d.shear[c] * n[b]);
      }
    }
    const double whole = square(d, shear_share, bend_share, twist_share);
    const bool stretched = d.extension > 0.0 && d.extension * d.extension > least_tension * whole;
    return stretched ? whole : 0.0;
  }

  double size(const double* own, const double* far) const {
    return square(deformation(own, far), shear_share, bend_share, twist_share);
  }

  double energy(const double* own_before, const double* far_before, const double* own,
                const double* far) const {
    const Deformation a = deformation(own_before, far_before), b = deformation(own, far);
    double shear = 0.0, bend = 0.0;
    for (int c = 0; c < Dim; ++c) shear += a.shear[c] * b.shear[c];
    for (std::size_t c = 0; c < std::size(a.bend); ++c) bend += a.bend[c] * b.bend[c];
    return 0.5 * (k * a.extension * b.extension + kb * shear + rotational * bend +
                  twisting * a.twist * b.twist);
  }

  template <class Visit>
  void for_stiffness(Visit visit) {
    visit(k);
    visit(kb);
    visit(rotational);
    visit(twisting);
  }

  bool is_compressed(const double* own, const double* far) const {
    return deformation(own, far).extension < 0.0;
  }
  FrameHalf axial_part(double stiffness) const {
    FrameHalf part = *this;
    part.for_stiffness([](double& modulus) { modulus = 0.0; });
    part.k = stiffness;
    return part;
  }
};

}  // namespace perilink
