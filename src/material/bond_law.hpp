#pragma once

#include <cmath>
#include <limits>

/// \file
/// Laws of a bond as a falling series of secant stiffnesses ("teeth"). A bond on tooth k carries
/// the force a_k s (per unit of its intact stiffness) up to the stretch s_k; there the next event
/// of the bond comes and its secant falls to a_(k+1). The implicit mode asks for secant and limit;
/// `force`, `energy` and `tangent` are the same law for every other use. Evaluation changes
/// nothing: the tooth is the only state and the caller owns it.

namespace perilink {

/// One secant of a law.
struct Tooth {
  double secant;  ///< stiffness as a fraction of the intact one [-]
  double limit;   ///< stretch of the next event [-]; infinity when there is none
};

/// Breaks for good at the critical stretch, in tension only (zeroth-order micro-elastic damage,
/// Gerstle, Sau & Silling 2005, Fig. 2 with s0 = s1).
struct BrittleLaw {
  double critical_stretch = std::numeric_limits<double>::infinity();

  Tooth tooth(int k) const {
    if (k == 0) return {1.0, critical_stretch};
    return {0.0, std::numeric_limits<double>::infinity()};
  }
};

/// Elastic and perfectly plastic bar as a saw-tooth about the plateau: with the ratio r of
/// neighbouring teeth a_k = r^-k and an event at s_k = s_y sqrt(r) r^k, so the force moves between
/// sqrt(r) and 1/sqrt(r) times the yield force and every tooth dissipates exactly the energy of the
/// plateau that it stands for. Yields alike in tension and compression; unloads along the secant.
struct PlateauLaw {
  double yield_strain = std::numeric_limits<double>::infinity();
  double ratio = 1.05;  ///< r > 1: ripple of about (r - 1) / 2 either side of the plateau

  Tooth tooth(int k) const {
    const double growth = std::pow(ratio, k);
    return {1.0 / growth, yield_strain * std::sqrt(ratio) * growth};
  }
};

/// Force of a bond per unit of its intact stiffness and length.
inline double bond_force(const Tooth& tooth, double stretch) { return tooth.secant * stretch; }

/// Energy of a bond per unit of its intact stiffness and length squared.
inline double bond_energy(const Tooth& tooth, double stretch) {
  return 0.5 * tooth.secant * stretch * stretch;
}

/// Derivative of the force with respect to the stretch.
inline double bond_tangent(const Tooth& tooth, double /*stretch*/) { return tooth.secant; }

}  // namespace perilink
