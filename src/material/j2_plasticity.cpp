#include "material/j2_plasticity.hpp"

#include <algorithm>
#include <cmath>

namespace perilink {
namespace {

constexpr int most_iterations = 200;  // Newton needs a few, bisection fewer than this

double product(const SymmetricTensor& a, const SymmetricTensor& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + 2.0 * (a[3] * b[3] + a[4] * b[4] + a[5] * b[5]);
}

SymmetricTensor deviator(SymmetricTensor tensor) {
  const double mean = (tensor[0] + tensor[1] + tensor[2]) / 3.0;
  for (int k = 0; k < 3; ++k) tensor[k] -= mean;
  return tensor;
}

SymmetricTensor hooke(const HookeConstants& constants, const SymmetricTensor& strain) {
  const double trace = strain[0] + strain[1] + strain[2];
  SymmetricTensor stress{};
  for (int k = 0; k < 6; ++k) {
    stress[k] = 2.0 * constants.mu * strain[k] + (k < 3 ? constants.lambda * trace : 0.0);
  }
  return stress;
}

/// Value and derivative of a function.
struct Sample {
  double value = 0.0, slope = 0.0;
};

/// Returns the zero in (0, upper] of a function that falls from a positive value at zero. Uses
/// Newton's method from zero, and bisection where a step leaves the interval.
template <typename Function>
double falling_zero(const Function& function, double upper) {
  double low = 0.0, high = upper, x = 0.0;
  for (int k = 0; k < most_iterations; ++k) {
    const Sample at = function(x);
    if (at.value == 0.0) return x;
    (at.value > 0.0 ? low : high) = x;
    double next = at.slope < 0.0 ? x - at.value / at.slope : high;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (next == low || next == high || next == x) return next;
    x = next;
  }
  return x;
}

double yield_slope(const YieldCurve& curve, double plastic_strain) {
  if (plastic_strain <= curve.ultimate_strain) {
    return curve.ultimate_strain > 0.0 ? (curve.ultimate - curve.yield) / curve.ultimate_strain
                                       : 0.0;
  }
  if (plastic_strain >= curve.failure_strain) return 0.0;
  return -curve.ultimate / (curve.failure_strain - curve.ultimate_strain);
}

void flow(const SymmetricTensor& direction, double amount, double equivalent, PlasticState& state) {
  for (int k = 0; k < 6; ++k) state.strain[k] += amount * direction[k];
  state.equivalent_strain += equivalent;
}

SymmetricTensor return_radially(const HookeConstants& constants, const YieldCurve& curve,
                                const SymmetricTensor& trial, PlasticState& state) {
  const double mises = mises_stress(trial), before = state.equivalent_strain;
  const SymmetricTensor s = deviator(trial);
  const double shear = 3.0 * constants.mu;
  const double amount = falling_zero(
      [&](double de) {
        return Sample{mises - shear * de - yield_stress(curve, before + de),
                      -shear - yield_slope(curve, before + de)};
      },
      mises / shear);
  SymmetricTensor stress = trial;
  const double scale = 1.5 * amount / mises;  // plastic strain = scale times trial deviator
  for (int k = 0; k < 6; ++k) stress[k] -= 2.0 * constants.mu * scale * s[k];
  flow(s, scale, amount, state);
  return stress;
}

/// Returns the plane-stress return, which decouples in sum, difference and shear. With the
/// multiplier g,
///   sum' = sum / (1 + E g / (3 (1 - nu))), difference and shear / (1 + 2 mu g),
/// where the plastic strain is g times the stress deviator.
SymmetricTensor return_in_plane(double youngs_modulus, double poissons_ratio,
                                const YieldCurve& curve, const SymmetricTensor& trial,
                                PlasticState& state) {
  const double mu = youngs_modulus / (2.0 * (1.0 + poissons_ratio));
  const double bulk = youngs_modulus / (3.0 * (1.0 - poissons_ratio));
  const double before = state.equivalent_strain;
  const double mean = 0.5 * (trial[0] + trial[1]), half = 0.5 * (trial[0] - trial[1]);
  const double square = half * half + trial[3] * trial[3];
  // Equivalent stress and its derivative at a multiplier.
  const auto mises_at = [&](double g) {
    const double grow = 1.0 + bulk * g, turn = 1.0 + 2.0 * mu * g;
    const double a = mean * mean / (grow * grow), b = 3.0 * square / (turn * turn);
    const double mises = std::sqrt(a + b);
    return Sample{mises, -(bulk * a / grow + 2.0 * mu * b / turn) / mises};
  };
  const auto excess = [&](double g) {
    const Sample mises = mises_at(g);
    const double strain = before + 2.0 / 3.0 * g * mises.value;
    return Sample{
        mises.value - yield_stress(curve, strain),
        mises.slope - yield_slope(curve, strain) * 2.0 / 3.0 * (mises.value + g * mises.slope)};
  };
  double upper = 1.0 / mu;
  while (excess(upper).value > 0.0 && upper < 1e12 / mu) upper *= 2.0;
  const double g = falling_zero(excess, upper);
  const double sum = 2.0 * mean / (1.0 + bulk * g), shrink = 1.0 / (1.0 + 2.0 * mu * g);
  const SymmetricTensor stress{
      0.5 * sum + half * shrink, 0.5 * sum - half * shrink, 0.0, trial[3] * shrink, 0.0, 0.0};
  flow(deviator(stress), g, 2.0 / 3.0 * g * mises_stress(stress), state);
  return stress;
}

}  // namespace

double yield_stress(const YieldCurve& curve, double plastic_strain) {
  if (plastic_strain <= curve.ultimate_strain) {
    const double part = curve.ultimate_strain > 0.0 ? plastic_strain / curve.ultimate_strain : 1.0;
    return curve.yield + (curve.ultimate - curve.yield) * part;
  }
  const double part =
      (plastic_strain - curve.ultimate_strain) / (curve.failure_strain - curve.ultimate_strain);
  return curve.ultimate * std::max(0.0, 1.0 - part);
}

double failure_strain(const YieldCurve& curve, double fracture_energy, double width) {
  return curve.ultimate_strain + 2.0 * fracture_energy / (curve.ultimate * width);
}

double mises_stress(const SymmetricTensor& stress) {
  const SymmetricTensor s = deviator(stress);
  return std::sqrt(1.5 * product(s, s));
}

SymmetricTensor return_stress(Problem problem, double youngs_modulus, double poissons_ratio,
                              const YieldCurve& curve, const SymmetricTensor& strain,
                              PlasticState& state) {
  const bool flat = problem == Problem::plane_stress;
  const HookeConstants constants = hooke_constants(problem, youngs_modulus, poissons_ratio);
  SymmetricTensor elastic = strain;
  for (int k = 0; k < 6; ++k) elastic[k] -= state.strain[k];
  if (flat) elastic[2] = elastic[4] = elastic[5] = 0.0;
  SymmetricTensor trial = hooke(constants, elastic);
  if (flat) trial[2] = 0.0;
  if (mises_stress(trial) <= yield_stress(curve, state.equivalent_strain)) return trial;
  return flat ? return_in_plane(youngs_modulus, poissons_ratio, curve, trial, state)
              : return_radially(constants, curve, trial, state);
}

}  // namespace perilink
