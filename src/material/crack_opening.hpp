#pragma once

namespace perilink {

/// Where cracks begin, and cohesive stress over crack opening in two straight branches: from the
/// strength at zero opening to `knee_ratio` times the strength at `knee_opening`, from there to
/// zero at `critical_opening`.
struct CrackOpeningLaw {
  double strength = 0.0;           ///< f_t [force/length^2]
  double knee_ratio = 0.25;        ///< gamma [-]
  double knee_opening = 0.0;       ///< COD_1 [length]
  double critical_opening = 0.0;   ///< COD_c [length]
  double compression_ratio = 6.0;  ///< compression over tensile strength that forbids damage
};

/// Whether a crack begins: where the first principal stress exceeds the strength and no other one
/// is below minus `compression_ratio` times the strength.
/// \param least  smallest of all three principal stresses, that out of the plane included
inline bool begins_crack(const CrackOpeningLaw& law, double first, double least) {
  return first > law.strength && least >= -law.compression_ratio * law.strength;
}

/// Area under the law [force/length].
double fracture_energy(const CrackOpeningLaw& law);

/// Damage of a band of the given width at a strain across it such that the band carries the
/// cohesive stress of the crack in it: (1 - damage) E strain = T(width (strain - T / E)). Exactly
/// zero at the strength and one at the critical opening; the band dissipates the fracture energy.
/// \param width   [length], less than max_band_width()
/// \param strain  total, across the band
double band_damage(const CrackOpeningLaw& law, double youngs_modulus, double strain, double width);

/// Width of a band beyond which its stress would fall faster than it unloads [length].
double max_band_width(const CrackOpeningLaw& law, double youngs_modulus);

/// Damage as Nikravesh & Gerstle (2018, Eq. 39) print it, with the total elongation of the band in
/// place of the opening, so that damage begins with a jump. Not below zero. Kept for comparison
/// with the papers of 2017 and 2018.
/// \param strain   in the band
/// \param opening  its equivalent crack opening [length]
double printed_damage(const CrackOpeningLaw& law, double youngs_modulus, double strain,
                      double opening);

/// Damage of bonds in compression around a particle with the given tensile damage (same paper,
/// Eq. 40): zero up to the threshold, one at full damage.
double compressive_damage(double tensile_damage, double threshold);

/// Stiffness of a bond whose two halves belong to particles with damages w_i and w_j, over the
/// intact stiffness: two springs in series (Eqs. 32 and 34). Zero where one is fully damaged.
double two_spring_factor(double w_i, double w_j);

/// Stretch of particle i's half of such a bond over the stretch of the whole bond (Eq. 35); one
/// where both particles are fully damaged.
double half_bond_share(double w_i, double w_j);

/// Weight of the stretch of such a bond in the sum of stretches of particle i: the energy of the
/// particle then is 1 - w_i times what its halves would store intact. The share times the square
/// root of 1 - w_i; from zero to one.
double half_bond_weight(double w_i, double w_j);

}  // namespace perilink
