#pragma once

#include <vector>

namespace perilink {

/// Damage of the solid particles of a body.
struct CrackPattern {
  int dim = 2;
  std::vector<double> positions;  ///< reference, shape (particles, dim) [length]
  std::vector<double> volumes;    ///< [length^3]
  std::vector<double> damage;     ///< 0 intact to 1 loose
};

/// Particles with at least this damage are cracked. A plane crack takes half of the bonds of the
/// particles beside it, and this share of those at a third of a horizon from it.
inline constexpr double cracked_damage = 0.3;

/// Where two bodies are cracked. Shares are not-a-number where their denominator is zero.
struct CrackOverlap {
  double volume_a = 0.0, volume_b = 0.0;  ///< volumes of cracked particles [length^3]
  double near_a = 0.0;   ///< share of volume_a within the tolerance of a cracked particle of b
  double near_b = 0.0;   ///< share of volume_b within the tolerance of a cracked particle of a
  double overlap = 0.0;  ///< cracked in both over cracked in either, by volume
};

/// Compares two bodies of the same dimension in their reference positions. A place is cracked in a
/// body when the particle nearest to it, within the tolerance, is; the volume that is cracked in
/// both is the mean of what particles of `a` and those of `b` count.
/// \param tolerance  distance that still counts as near, positive [length]
CrackOverlap crack_overlap(const CrackPattern& a, const CrackPattern& b, double tolerance);

}  // namespace perilink
