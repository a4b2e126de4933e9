#pragma once

#include <array>

/// \file
/// Stress intensity factors of cracked bodies, from handbooks, and the direction in which a crack
/// turns. Plane stress throughout: a crack grows where K = sqrt(E G_F).

namespace perilink::verification {

/// F of K = sigma sqrt(pi a) F for a plate of the width W with an edge crack of the length a under
/// uniform tension, 0.5 % up to a/W = 0.6 (Gross & Brown in Tada, Paris & Irwin 2000, part 2.10).
/// \param part  a/W [-]
double edge_crack_factor(double part);

/// The same of a crack of the length 2 a in the middle of a plate of the width 2 b, 0.1 % (Tada,
/// Paris & Irwin 2000, part 2.1).
/// \param part  a/b [-]
double centre_crack_factor(double part);

/// Load at which the crack of a beam on three points grows, span four times the height (Srawley
/// 1976; 0.5 % for any length of the crack) [force].
double three_point_peak_load(double youngs_modulus, double fracture_energy, double height,
                             double thickness, double crack);

/// The same of a double cantilever with arms of the height H, 2 <= a/H <= 10 (Gross & Srawley 1966;
/// K = P a (3.46 + 2.38 H/a) / (B H^1.5), 1 %) [force].
double double_cantilever_load(double youngs_modulus, double fracture_energy, double arm,
                              double thickness, double crack);

/// Angle by which a crack turns by the largest hoop stress, K_I sin t + K_II (3 cos t - 1) = 0
/// (Erdogan & Sih 1963, Eq. 12) [radians]; negative for positive K_II.
/// \param mixity  atan2(K_II, K_I), 0 to pi/2 [radians]
double hoop_stress_kink(double mixity);

/// Stress intensity factors K_I and K_II of a short straight kink (Amestoy & Leblond 1992, the
/// expansions in the angle), as a crack without it has them by K_I = cos(mixity), K_II =
/// sin(mixity).
/// \param angle  by which the kink turns [radians]
std::array<double, 2> kinked_factors(double mixity, double angle);

/// Angle at which the energy release of a short kink is largest [radians].
double energy_release_kink(double mixity);

}  // namespace perilink::verification
