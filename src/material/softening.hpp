#pragma once

#include <array>
#include <limits>
#include <vector>

#include "material/bond_law.hpp"

/// \file
/// Bonds that soften: beyond the stretch s_0 their force falls gradually to zero. Forces and
/// stretches are given over those at s_0.

namespace perilink {

/// How the force of a bond falls.
enum class Softening {
  brittle,      ///< at once (Gerstle, Sau & Silling 2005, Fig. 2 with s_0 = s_1)
  linear,       ///< along a straight line (the same figure)
  bilinear,     ///< along two straight lines with a knee between them (Petersson 1981)
  exponential,  ///< in proportion to itself
  concrete,     ///< at once after a plateau, in tension and in compression (Gerstle, Sau & Aguilera
                ///< 2007, section 6)
};

struct SofteningShape {
  Softening kind = Softening::brittle;
  double knee_force = 1.0 / 3.0;    ///< bilinear: force at the knee over that at s_0 [-]
  double knee_stretch = 2.0 / 9.0;  ///< (s_knee - s_0) / (s_1 - s_0), s_1 where it ends [-]
};

/// How the bonds of a material soften.
struct SofteningMaterial {
  SofteningShape shape;
  bool closes = false;  ///< damaged bonds resist compression like intact ones
  double error = 0.01;  ///< by which the teeth may raise the strength [-]
  double tensile_strength = std::numeric_limits<double>::infinity();  ///< f_t [force/length^2]
  /// Where the force of a bond begins to fall and has fallen to zero, in place of f_t and fracture
  /// energy [-]; zeros: from these.
  std::array<double, 2> stretches{};
  /// Concrete: where the force of a bond in compression ceases to grow and falls to zero [-].
  std::array<double, 2> crushing{};
  bool shear_softens = false;  ///< concrete: shear falls with the axial stiffness
};

/// Area under the curve of this shape that ends at s_1 over that of its elastic part,
/// 2 G_s / s_0^2; exponential curves have no end and no such energy.
/// \param end  s_1 / s_0
double softening_energy(const SofteningShape& shape, double end);

/// Force over stretch of one bond: x up to x = 1, falling from there.
/// Concrete has a plateau and a fall at once, which is a knee at the end.
class SofteningCurve {
 public:
  /// \param energy  area under the curve over that of its elastic part, 2 G_s / s_0^2: more than
  ///     one, or the bond would release more than it takes
  /// \throws std::invalid_argument where it is not, or the shape is brittle
  SofteningCurve(const SofteningShape& shape, double energy);

  double force(double x) const;
  /// Area under the curve from zero to x.
  double area(double x) const;
  /// Where the force has fallen to zero, s_1 / s_0; exponential ones end at a force of 1e-4.
  double end() const { return end_; }

 private:
  double knee_, end_;
  double knee_force_;
  double decay_;  ///< stretch by which the force falls to 1/e; 0: straight lines
};

/// The curve as falling secants. Between the points S_k < S_(k+1) where the secants a_k and a_(k+1)
/// leave it lies the energy E_k = integral of the force + (a_k S_k^2 - a_(k+1) S_(k+1)^2) / 2; the
/// tooth dissipates exactly this by its event at s_k = sqrt(2 E_k / (a_k - a_(k+1))), which on a
/// straight piece is sqrt(S_k S_(k+1)).
/// \param ripple  most by which the force of a tooth rises above the curve [-]; all teeth but the
///     last rise so far
/// \throws std::invalid_argument unless the ripple is positive, or for a curve too flat to tell
std::vector<Segment> segments_of(const SofteningCurve& curve, double overshoot);
BondLaw saw_tooth_of(const SofteningCurve& curve, double overshoot);

}  // namespace perilink
