#include "half_space.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace perilink::verification {
namespace {

using std::numbers::pi;

/// A_k and B_k are the integrals over all directions, u the cosine with the normal, of u^2k R^4 / 4
/// and u^2k R^2 / 2, where R = min(1, x / |u|) is how far bonds reach towards the surface.
LayerStiffness half_space(double c, double d, double x) {
  const double x2 = x * x, x3 = x2 * x, x4 = x2 * x2, x5 = x4 * x;
  const double a0 = (1 + x) / 4 + (x - x4) / 12;
  const double a1 = (1 + x3) / 12 + (x3 - x4) / 4;
  const double a2 = (1 + x5) / 20 + x4 * (1 - x) / 4;
  const double b0 = 0.5 + x - x2 / 2;
  const double b1 = (1 + x3) / 6 + x2 * (1 - x) / 2;
  const double b2 = (1 + x5) / 10 + (x2 - x5) / 6;
  const double a_across = a0 - 2 * a1 + a2, b_across = b0 - 2 * b1 + b2;  // factor of (1 - u^2)^2
  return {2 * pi * (c / 2 * a2 + 6 * d * (b1 - b2)),
          2 * pi * (c / 4 * (a1 - a2) - 3 * d * (b1 - b2)),
          2 * pi * (3 * c / 16 * a_across + 6 * d * ((b0 - b1) / 2 - 3.0 / 8 * b_across)),
          2 * pi * (c / 16 * a_across - 3 * d / 4 * b_across)};
}

/// Integrals over all directions, theta the angle with the normal, of products of cosines and sines
/// times R^3 and R.
LayerStiffness half_plane(double c, double d, double x) {
  const double alpha = std::acos(x), s = std::sin(alpha), beta = pi - alpha;
  const double x3 = x * x * x;
  const double log = x > 0.0 ? x3 * std::atanh(s) : 0.0;  // x^3 times integral of 1 / cos
  const double s2 = std::sin(2 * beta) / 4, s4 = std::sin(4 * beta) / 32;
  const double cccc = 2 * (3 * beta / 8 + s2 + s4 + x3 * s);
  const double ccss = 2 * (beta / 8 - s4 + log - x3 * s);
  const double ssss = 2 * (3 * beta / 8 - s2 + s4 + x * s / 2 - 1.5 * log + x3 * s);
  const double shear = 2 * (beta / 8 - s4 + x * s * s * s / 3);
  return {c / 6 * cccc + 6 * d * shear, c / 6 * ccss - 6 * d * shear, c / 6 * ssss + 6 * d * shear,
          0.0};
}

LayerStiffness combine(const LayerStiffness& a, double factor, const LayerStiffness& b) {
  return {a.c11 + factor * b.c11, a.c12 + factor * b.c12, a.c22 + factor * b.c22,
          a.c23 + factor * b.c23};
}

}  // namespace

LayerModuli layer_moduli(Problem problem, const LayerStiffness& c) {
  if (problem == Problem::plane_stress) {
    return {c.c11 - c.c12 * c.c12 / c.c22, c.c22 - c.c12 * c.c12 / c.c11, c.c12 / c.c22,
            c.c12 / c.c11};
  }
  // Inverse of the stiffness: sum and difference of the two directions in the surface decouple.
  const double sum = c.c22 + c.c23, difference = c.c22 - c.c23;
  const double determinant = c.c11 * sum - 2 * c.c12 * c.c12;
  const double s11 = sum / determinant, s12 = -c.c12 / determinant;
  const double s22 = 0.5 * (c.c11 / determinant + 1 / difference);
  const double s23 = 0.5 * (c.c11 / determinant - 1 / difference);
  return {1 / s11, 1 / s22, -s12 / s11, -s23 / s22};
}

LayerStiffness layer_stiffness(Problem problem, const MicropolarModuli& moduli, double horizon,
                               double depth) {
  const double x = std::min(depth, 1.0);
  const double c = moduli.micromodulus, d = moduli.bending_modulus;
  return problem == Problem::plane_stress
             ? half_plane(c * std::pow(horizon, 3), d * horizon, x)
             : half_space(c * std::pow(horizon, 4), d * horizon * horizon, x);
}

LayerStiffness plate_stiffness(Problem problem, const MicropolarModuli& moduli, double horizon,
                               double width) {
  const LayerStiffness bulk = layer_stiffness(problem, moduli, horizon, 1.0);
  LayerStiffness mean = bulk;
  // Midpoint rule: the integrand has a logarithm at the surface, its error is below 1e-7.
  constexpr int steps = 2000;
  const double reach = std::min(width, 1.0), step = reach / steps;
  for (int k = 0; k < steps; ++k) {
    const LayerStiffness layer = layer_stiffness(problem, moduli, horizon, (k + 0.5) * step);
    mean = combine(mean, -2 * step / width, combine(bulk, -1.0, layer));
  }
  return mean;
}

}  // namespace perilink::verification
