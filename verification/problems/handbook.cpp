#include "handbook.hpp"

#include <cmath>
#include <initializer_list>
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

std::array<double, 2> kinked_factors(double mixity, double angle) {
  constexpr double p = std::numbers::pi, p2 = p * p, p3 = p2 * p, p4 = p2 * p2, p5 = p4 * p;
  constexpr double p6 = p3 * p3;
  const double m = angle / p, q = m * m;
  // Each sum by falling powers of q.
  const auto sum = [q](std::initializer_list<double> coefficients) {
    double value = 0.0;
    for (const double c : coefficients) value = value * q + c;
    return value;
  };
  const double f11 = sum({4.1, 1.63, -4.059, 2.996, -0.0925, -2.88312, 5.07790,
                          p2 / 9.0 - 11.0 * p4 / 72.0 + 119.0 * p6 / 15360.0, p2 - 5.0 * p4 / 128.0,
                          -3.0 * p2 / 8.0, 1.0});
  const double f12 = m * sum({4.56, 4.21, -6.915, 4.0216, 1.5793, -7.32433, 12.313906,
                              -2.0 * p - 133.0 * p3 / 180.0 + 59.0 * p5 / 1280.0,
                              10.0 * p / 3.0 + p3 / 16.0, -1.5 * p});
  const double f21 = m * sum({-1.32, -3.95, 4.684, -2.0700, -1.5340, 4.44112, -6.176023,
                              -2.0 * p / 3.0 + 13.0 * p3 / 30.0 - 59.0 * p5 / 3840.0,
                              -4.0 * p / 3.0 - p3 / 48.0, 0.5 * p});
  const double f22 =
      sum({12.5, 0.25, -7.591, 7.280, -1.8804, -4.78511, 10.58254,
           -32.0 / 15.0 - 4.0 * p2 / 9.0 - 1159.0 * p4 / 7200.0 + 119.0 * p6 / 15360.0,
           8.0 / 3.0 + 29.0 * p2 / 18.0 - 5.0 * p4 / 128.0, -4.0 - 3.0 * p2 / 8.0, 1.0});
  const double one = std::cos(mixity), two = std::sin(mixity);
  return {f11 * one + f12 * two, f21 * one + f22 * two};
}

double energy_release_kink(double mixity) {
  constexpr double step = std::numbers::pi / 180.0 / 100.0;
  double most = 0.0, best = 0.0;
  for (int k = 0; k < 9000; ++k) {
    const auto [one, two] = kinked_factors(mixity, -k * step);
    const double release = one > 0.0 ? one * one + two * two : 0.0;
    if (release <= most) continue;
    most = release;
    best = -k * step;
  }
  return best;
}

}  // namespace perilink::verification
