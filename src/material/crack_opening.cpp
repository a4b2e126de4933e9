#include "material/crack_opening.hpp"

#include <algorithm>
#include <cmath>

namespace perilink {
namespace {

double first_slope(const CrackOpeningLaw& law) {
  return law.strength * (1.0 - law.knee_ratio) / law.knee_opening;
}

double second_slope(const CrackOpeningLaw& law) {
  return law.strength * law.knee_ratio / (law.critical_opening - law.knee_opening);
}

}  // namespace

double fracture_energy(const CrackOpeningLaw& law) {
  return 0.5 * law.strength * (law.knee_opening + law.knee_ratio * law.critical_opening);
}

double max_band_width(const CrackOpeningLaw& law, double youngs_modulus) {
  return youngs_modulus / std::max(first_slope(law), second_slope(law));
}

double band_damage(const CrackOpeningLaw& law, double youngs_modulus, double strain, double width) {
  const double elastic = youngs_modulus * strain;
  if (elastic <= law.strength) return 0.0;
  if (width * strain >= law.critical_opening) return 1.0;
  const double knee_strain =
      law.knee_opening / width + law.knee_ratio * law.strength / youngs_modulus;
  const bool first = strain < knee_strain;
  // The branch is T = T_0 - m w with w = width (strain - T / E).
  const double slope = first ? first_slope(law) : second_slope(law);
  const double at_zero = first ? law.strength : slope * law.critical_opening;
  const double stress = (at_zero - slope * width * strain) / (1.0 - slope * width / youngs_modulus);
  return 1.0 - stress / elastic;
}

double printed_damage(const CrackOpeningLaw& law, double youngs_modulus, double strain,
                      double opening) {
  if (opening <= 0.0 || strain <= 0.0) return 0.0;
  if (opening >= law.critical_opening) return 1.0;
  const double stress =
      opening < law.knee_opening
          ? law.strength * (1.0 + (law.knee_ratio - 1.0) * opening / law.knee_opening)
          : law.strength * law.knee_ratio * (law.critical_opening - opening) /
                (law.critical_opening - law.knee_opening);
  return std::max(0.0, 1.0 - stress / (youngs_modulus * strain));
}

double compressive_damage(double tensile_damage, double threshold) {
  if (tensile_damage <= threshold) return 0.0;
  const double root = std::sqrt(threshold);
  return (std::sqrt(tensile_damage) - root) / (1.0 - root);
}

double two_spring_factor(double w_i, double w_j) {
  const double intact = 2.0 - w_i - w_j;
  return intact > 0.0 ? 2.0 * (1.0 - w_i) * (1.0 - w_j) / intact : 0.0;
}

double half_bond_share(double w_i, double w_j) {
  const double intact = 2.0 - w_i - w_j;
  return intact > 0.0 ? 2.0 * (1.0 - w_j) / intact : 1.0;
}

double half_bond_weight(double w_i, double w_j) {
  return std::sqrt(1.0 - w_i) * half_bond_share(w_i, w_j);
}

}  // namespace perilink
