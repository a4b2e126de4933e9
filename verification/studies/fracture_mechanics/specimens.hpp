#pragma once

#include <array>
#include <string>

#include "arrangement.hpp"

/// \file
/// Cracked bodies for which linear elastic fracture mechanics has a closed form. Young's modulus is
/// 1000, the fracture energy 1, the thickness 1.

namespace perilink::verification {

inline constexpr double youngs_modulus = 1000.0, fracture_energy = 1.0;

/// Bonds and particles.
struct Make {
  Arrangement arrangement;
  bool micropolar = false;  ///< Poisson's ratio 0.2
  bool softens = false;     ///< bilinear; else brittle
  double spacing = 1.0;     ///< [length]
  double horizon_ratio = 3.0;
  double zone = 1.0;    ///< E G_F / f_t^2 over the horizon, where bonds soften
  double radius = 8.0;  ///< half of the width of crack_tip_field() in horizons
  double turned = 0.0;  ///< angle of the crack of crack_tip_field() against x [radians]

  double horizon() const { return horizon_ratio * spacing; }
  double poissons_ratio() const { return micropolar ? 0.2 : 1.0 / 3.0; }
};

/// "micropolar,bilinear", for tables.
std::string bonds_of(const Make& make);

/// Where the middle of the bonds that are about to break lies before the tip, in horizons: a
/// specimen bears its largest load when it has cracked so far.
inline constexpr double ahead = 1.0 / 3.0;

struct Specimen {
  std::string text;             ///< the case
  std::array<double, 2> tip{};  ///< end of the crack that is there before [length]
  /// Load at which the crack grows by the closed form [force]; zero: there is none.
  double load = 0.0;
  /// The same of a crack that is longer by `ahead` horizons [force].
  double later_load = 0.0;
};

/// Plate of the width 100 and the height 200 under uniform tension, with an edge crack of 0.4 of
/// the width (single edge notched tension).
Specimen edge_crack(const Make& make);

/// The same plate with a crack in the middle, half of the width long.
Specimen centre_crack(const Make& make);

/// Beam of the height 100 on three points with a crack of 0.4 of it (single edge notched bending).
Specimen bent_beam(const Make& make);

/// Arms of the height 100, cracked for two and a half of it; they break only within one horizon of
/// the plane of the crack.
Specimen double_cantilever(const Make& make);

/// Plate with a crack to its middle whose rim, a horizon wide, is driven by the displacements
/// about the tip of a crack in an infinite body. Nothing breaks near the rim and behind the tip.
/// \param mixity  atan2(K_II, K_I) [radians]
Specimen crack_tip_field(const Make& make, double mixity);

/// Strip between clamps, eight horizons high, as the text of a case by the tip of its crack.
std::string clamped_strip(const Make& make, double tip);

/// Tips of clamped_strip(): from where the crack grows, and between which it is measured [length].
std::array<double, 3> tips_of_strip(const Make& make);

}  // namespace perilink::verification
