#include "handbook.hpp"

#include <cmath>
#include <numbers>

namespace perilink::verification {

double edge_crack_factor(double part) {
  return 1.122 + part * (-0.231 + part * (10.55 + part * (-21.71 + part * 30.382)));
}

double centre_crack_factor(double part) {
  const double square = part * part;
  return (1.0 - 0.025 * square + 0.06 * square * square) *
         std::sqrt(1.0 / std::cos(0.5 * std::numbers::pi * part));
}

double three_point_peak_load(double youngs_modulus, double fracture_energy, double height,
                             double thickness, double crack) {
  const double a = crack / height, span = 4.0 * height;
  const double f = 3.0 * std::sqrt(a) * (1.99 - a * (1.0 - a) * (2.15 - 3.93 * a + 2.7 * a * a)) /
                   (2.0 * (1.0 + 2.0 * a) * std::pow(1.0 - a, 1.5));
  return std::sqrt(youngs_modulus * fracture_energy) * thickness * std::pow(height, 1.5) /
         (span * f);
}

double double_cantilever_load(double youngs_modulus, double fracture_energy, double arm,
                              double thickness, double crack) {
  return std::sqrt(youngs_modulus * fracture_energy) * thickness * std::pow(arm, 1.5) /
         (3.46 * crack + 2.38 * arm);
}

double hoop_stress_kink(double mixity) {
  const double one = std::cos(mixity), two = std::sin(mixity);
  if (two == 0.0) return 0.0;
  // With h = tan(t/2): K_I h + K_II (1 - 2 h^2) = 0.
  return 2.0 * std::atan((one - std::sqrt(one * one + 8.0 * two * two)) / (4.0 * two));
}

}  // namespace perilink::verification
