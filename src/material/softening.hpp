#pragma once

#include <array>
#include <limits>
#include <vector>

#include "material/bond_law.hpp"

/// \file
/// Softening bonds: beyond the stretch s_0 their force falls to zero. Forces and stretches are
/// relative to those at s_0.

namespace perilink {

/// Shape of the softening branch.
enum class Softening {
  brittle,      ///< immediately (Gerstle, Sau & Silling 2005, Fig. 2 with s_0 = s_1)
  linear,       ///< along a straight line (the same figure)
  bilinear,     ///< along two straight lines with a knee between them (Petersson 1981)
  exponential,  ///< at a rate proportional to the force
  points,       ///< along straight lines between given points
  concrete,     ///< immediately after a plateau, in tension and in compression (Gerstle, Sau &
                ///< Aguilera 2007, section 6)
};

struct SofteningShape {
  Softening kind = Softening::brittle;
  double knee_force = 1.0 / 3.0;    ///< bilinear: force at the knee over that at s_0 [-]
  double knee_stretch = 2.0 / 9.0;  ///< (s_knee - s_0) / (s_1 - s_0), with s_1 at zero force [-]
  /// Softening::points: (s - s_0) / (s_1 - s_0), rising, and force over that at s_0, not rising;
  /// both in (0, 1) [-]. The ends (0, 1) and (1, 0) are left out.
  std::vector<std::array<double, 2>> points = {};
};

/// Softening of the bonds of a material.
struct SofteningMaterial {
  SofteningShape shape;
  bool closes = false;  ///< damaged bonds resist compression like intact ones
  double error = 0.01;  ///< largest strength error due to the saw-tooth segments [-]
  double tensile_strength = std::numeric_limits<double>::infinity();  ///< f_t [force/length^2]
  /// Stretches at peak force and at zero force, instead of f_t and fracture energy [-]; zeros:
  /// derived from these.
  std::array<double, 2> stretches{};
  /// Concrete: stretches at peak force and at zero force in compression [-].
  std::array<double, 2> crushing{};
  bool shear_softens = false;  ///< concrete: shear falls with the axial stiffness
};

/// Returns the area under a curve that ends at s_1 over the area of its elastic part, 2 G_s / s_0^2
/// [-]. Exponential curves have no end and no such energy.
/// \param end  s_1 / s_0 [-]
double softening_energy(const SofteningShape& shape, double end);

/// Force over stretch of one bond: x up to x = 1, then falling, exponentially or along straight
/// lines. Concrete has a plateau with an immediate fall.
class SofteningCurve {
 public:
  /// \param energy  area under the curve over the area of its elastic part, 2 G_s / s_0^2 [-]; must
  ///                be above one
  /// \throws std::invalid_argument for a smaller energy or a brittle shape
  SofteningCurve(const SofteningShape& shape, double energy);

  double force(double x) const;
  /// Returns the area under the curve from zero to x.
  double area(double x) const;
  /// Returns the stretch at zero force, s_1 / s_0; exponential curves end at a force of 1e-4.
  double end() const { return end_; }

 private:
  /// Ends of the straight lines (x, force) from (1, 1) to a force of zero; two with one x: an
  /// immediate fall.
  std::vector<std::array<double, 2>> corners_;
  double end_;
  double decay_ = 0.0;  ///< stretch over which the force falls to 1/e; 0: straight lines
};

/// Returns the curve as saw-tooth segments. The secants a_k and a_(k+1) leave the curve at
/// S_k < S_(k+1). Between these points a segment dissipates exactly the energy of the curve,
///   E_k = integral of the force + (a_k S_k^2 - a_(k+1) S_(k+1)^2) / 2.
/// Its event is at s_k = sqrt(2 E_k / (a_k - a_(k+1))). On a straight piece s_k is
/// sqrt(S_k S_(k+1)).
/// \param overshoot  largest excess of a segment's force over the curve [-]; all segments but the
///                   last have it
/// \throws std::invalid_argument for an overshoot that is not positive, or a curve too flat for
///     segments
std::vector<Segment> segments_of(const SofteningCurve& curve, double overshoot);
BondLaw saw_tooth_of(const SofteningCurve& curve, double overshoot);

}  // namespace perilink
