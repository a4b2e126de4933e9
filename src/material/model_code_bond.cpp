#include "material/model_code_bond.hpp"

#include <algorithm>
#include <cmath>

namespace perilink {
namespace {

constexpr double exponent = 0.4;
/// End of the first straight line, over the slip at the strength, and the number of pieces of the
/// curve.
constexpr double first_slip = 1e-3;
constexpr int pieces = 60;

}  // namespace

ForceCurve model_code_curve(const ModelCodeBond& bond) {
  const bool good = bond.conditions == BondConditions::good;
  const double strength = bond.mean_strength / bond.megapascal;  // in MPa; slips in mm
  const double pulled_out = (good ? 2.5 : 1.25) * std::sqrt(strength);
  double most = pulled_out, first = good ? 1.0 : 1.8, second = good ? 2.0 : 3.6;
  double third = bond.rib_spacing / bond.millimetre, friction = 0.4;
  if (bond.failure != BondFailure::pull_out) {
    const bool held = bond.failure == BondFailure::splitting_stirrups;
    const double factor = good ? (held ? 8.0 : 7.0) : (held ? 5.5 : 5.0);
    const double split = factor * std::pow(strength / 25.0, 0.25);
    if (split < most) {
      first *= std::pow(split / most, 1.0 / exponent);
      most = split;
    }
    second = first;
    third = held ? 0.5 * third : 1.2 * first;
    friction = held ? 0.4 : 0.0;
  }
  ForceCurve curve;
  curve.endless = friction > 0.0;
  const auto add = [&](double slip, double stress) {
    curve.points.push_back({slip * bond.millimetre, stress * bond.megapascal});
  };
  for (int k = 0; k <= pieces; ++k) {
    const double part = std::pow(first_slip, 1.0 - static_cast<double>(k) / pieces);
    add(first * part, most * std::pow(part, exponent));
  }
  if (second > first) add(second, most);
  add(std::max(third, 1.001 * second), friction * most);
  return curve;
}

}  // namespace perilink
