#pragma once

namespace perilink {

/// Criterion for new cracks, and cohesive stress over crack opening in two straight branches. The
/// stress falls from the strength at zero opening to `knee_ratio` times the strength at
/// `knee_opening`, then to zero at `critical_opening`.
struct CrackOpeningLaw {
  double strength = 0.0;           ///< f_t [force/length^2]
  double knee_ratio = 0.25;        ///< gamma [-]
  double knee_opening = 0.0;       ///< COD_1 [length]
  double critical_opening = 0.0;   ///< COD_c [length]
  double compression_ratio = 6.0;  ///< compressive over tensile strength that prevents damage
};

/// Returns whether a crack begins: the first principal stress exceeds the strength, and no other
/// one is below minus `compression_ratio` times the strength.
/// \param least  smallest of all three principal stresses [force/length^2]
inline bool begins_crack(const CrackOpeningLaw& law, double first, double least) {
  return first > law.strength && least >= -law.compression_ratio * law.strength;
}

/// Returns the area under the law [force/length].
double fracture_energy(const CrackOpeningLaw& law);

/// Returns the damage of a band at a strain across it. The band then carries the cohesive stress of
/// its crack: (1 - damage) E strain = T(width (strain - T / E)). Damage is exactly zero at the
/// strength and one at the critical opening; the band dissipates the fracture energy.
/// \param strain  total, across the band [-]
/// \param width   width of the band [length], less than max_band_width()
double band_damage(const CrackOpeningLaw& law, double youngs_modulus, double strain, double width);

/// Returns the width of a band above which its stress would fall faster than it unloads [length].
double max_band_width(const CrackOpeningLaw& law, double youngs_modulus);

/// Returns the damage as printed by Nikravesh & Gerstle (2018, Eq. 39), not below zero. The printed
/// equation has the total elongation of the band instead of the opening, so that damage begins with
/// a jump. It serves for comparison with Nikravesh (2017) and Nikravesh & Gerstle (2018).
/// \param strain   in the band [-]
/// \param opening  equivalent crack opening [length]
double printed_damage(const CrackOpeningLaw& law, double youngs_modulus, double strain,
                      double opening);

/// Returns the damage of bonds in compression around a particle with the given tensile damage
/// (Nikravesh & Gerstle 2018, Eq. 40). It is zero up to the threshold and one at full damage.
double compressive_damage(double tensile_damage, double threshold);

/// Returns the stiffness of a bond between particles with damages w_i and w_j, over the intact
/// stiffness [-]. Its halves are two springs in series (Eqs. 32 and 34). Zero if one particle is
/// fully damaged.
double two_spring_factor(double w_i, double w_j);

/// Returns the stretch of particle i's half of a bond over the stretch of the whole bond (Eq. 35)
/// [-]. One if both particles are fully damaged.
double half_bond_share(double w_i, double w_j);

/// Returns the weight of the stretch of a bond in the sum of stretches of particle i, from zero to
/// one. With it the particle's energy is 1 - w_i times the energy that its halves would store
/// intact. It is half_bond_share() times the square root of 1 - w_i.
double half_bond_weight(double w_i, double w_j);

}  // namespace perilink
