#pragma once

#include <vector>

namespace perilink {

/// Damage of the solid particles of a body.
struct CrackPattern {
  int dim = 2;
  std::vector<double> positions;  ///< reference, shape (particles, dim) [length]
  std::vector<double> volumes;    ///< [length^3]
  std::vector<double> damage;     ///< 0 intact to 1 no bond left
};

/// Damage from which a particle counts as cracked. A plane crack breaks half of the bonds of
/// adjacent particles, and this fraction of the bonds of particles a third of a horizon away.
inline constexpr double cracked_damage = 0.3;

/// Overlap of the cracks of two bodies. Fractions are not-a-number where their denominator is zero.
struct CrackOverlap {
  double volume_a = 0.0, volume_b = 0.0;  ///< volumes of cracked particles [length^3]
  double near_a = 0.0;   ///< share of volume_a within the tolerance of a cracked particle of b
  double near_b = 0.0;   ///< share of volume_b within the tolerance of a cracked particle of a
  double overlap = 0.0;  ///< cracked in both over cracked in either, by volume
};

/// Compares the cracks of two bodies of equal dimension in their reference positions. A point is
/// cracked in a body if the nearest particle within the tolerance is cracked. The volume cracked in
/// both is the mean of the counts over particles of `a` and over particles of `b`.
/// \param tolerance  largest distance of particles that count as near, positive [length]
CrackOverlap crack_overlap(const CrackPattern& a, const CrackPattern& b, double tolerance);

}  // namespace perilink
