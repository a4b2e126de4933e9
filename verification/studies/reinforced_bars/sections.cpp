#include "sections.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace perilink::verification {

double elastic_zone(const Section& s) {
  const double a = s.steel / s.concrete * s.area / s.width;
  return -a + std::sqrt(a * a + 2.0 * a * s.depth);
}

double elastic_arm(const Section& s) { return s.depth - elastic_zone(s) / 3.0; }

double yield_moment(const Section& s) { return s.area * s.yield * elastic_arm(s); }

double plastic_moment(const Section& s, double steel_strain) {
  // x^2 = c (d - x)
  const double c = 2.0 * s.area * s.yield / (s.width * s.concrete * steel_strain);
  const double zone = 0.5 * (-c + std::sqrt(c * c + 4.0 * c * s.depth));
  return s.area * s.yield * (s.depth - zone / 3.0);
}

namespace {

double stress_at(const std::vector<std::array<double, 2>>& curve, double strain) {
  for (std::size_t k = 1; k < curve.size(); ++k) {
    const auto &a = curve[k - 1], &b = curve[k];
    if (strain < a[0] || strain > b[0]) continue;
    return a[1] + (strain - a[0]) / (b[0] - a[0]) * (b[1] - a[1]);
  }
  return 0.0;
}

struct Resultants {
  double force = 0.0, moment = 0.0, steel = 0.0;  ///< moment about the upper face
};

/// Strain over the depth below the upper face: -top (1 - y / zone).
Resultants resultants(const Section& s, const std::vector<std::array<double, 2>>& concrete,
                      double top, double zone) {
  Resultants sum;
  const int layers = 400;
  const double dy = s.height / layers;
  for (int k = 0; k < layers; ++k) {
    const double y = (k + 0.5) * dy;
    const double force = stress_at(concrete, -top * (1.0 - y / zone)) * s.width * dy;
    sum.force += force;
    sum.moment += force * y;
  }
  sum.steel = std::clamp(-s.steel * top * (1.0 - s.depth / zone), -s.yield, s.yield);
  sum.force += s.area * sum.steel;
  sum.moment += s.area * sum.steel * s.depth;
  return sum;
}

}  // namespace

CrushingMoment crushing_moment(const Section& s,
                               const std::vector<std::array<double, 2>>& concrete) {
  CrushingMoment largest;
  for (double top = 1e-4; top < 6e-3; top += 2e-5) {
    double low = 0.01 * s.height, high = s.height;  // the force falls as the zone grows
    for (int k = 0; k < 50; ++k) {
      const double zone = 0.5 * (low + high);
      (resultants(s, concrete, top, zone).force > 0.0 ? low : high) = zone;
    }
    const Resultants at = resultants(s, concrete, top, 0.5 * (low + high));
    if (at.moment > largest.moment) largest = {at.moment, at.steel, top};
  }
  return largest;
}

double uncracked_modulus(const Section& s) {
  const double extra = (s.steel / s.concrete) * s.area;  // steel lies beside the concrete
  const double gross = s.width * s.height;
  const double centre = (gross * 0.5 * s.height + extra * s.depth) / (gross + extra);
  const double inertia = gross * s.height * s.height / 12.0 +
                         gross * std::pow(centre - 0.5 * s.height, 2) +
                         extra * std::pow(s.depth - centre, 2);
  return inertia / (s.height - centre);
}

double model_code_bending_factor(double height) {
  const double part = 0.06 * std::pow(height, 0.7);
  return (1.0 + part) / part;
}

double TensionMember::steel_area() const { return 0.25 * std::numbers::pi * diameter * diameter; }

double model_code_transfer_length(const TensionMember& m) {
  return m.cover + m.diameter / (4.0 * 1.8 * m.ratio());
}

double model_code_cracking_stress(const TensionMember& m) {
  return m.strength / m.ratio() * (1.0 + m.steel / m.concrete * m.ratio());
}

double model_code_mean_strain(const TensionMember& m, double stress) {
  return (stress - 0.6 * model_code_cracking_stress(m)) / m.steel;
}

namespace {

struct ChainEnd {
  double stress = 0.0, mean_strain = 0.0;
};

/// From the middle between two cracks, where nothing slips, to a crack.
/// \param middle  stress of the steel in the middle  \param force  of the member over A_s
ChainEnd integrate_chain(const TensionMember& m, const ForceCurve& bond, double half, double middle,
                         double force) {
  const int steps = 400;
  const double dx = half / steps;
  double slip = 0.0, stress = middle, extension = 0.0;
  const auto stretch = [&] { return stress / m.steel - m.ratio() * (force - stress) / m.concrete; };
  for (int k = 0; k < steps; ++k) {
    extension += 0.5 * dx * stress / m.steel;
    const double between = slip + 0.5 * dx * stretch();
    stress += dx * 4.0 * bond.force(between) / m.diameter;
    slip = between + 0.5 * dx * stretch();
    extension += 0.5 * dx * stress / m.steel;
  }
  return {stress, extension / half};
}

}  // namespace

namespace {

/// Stress of the steel in the middle between two cracks.
double middle_stress(const TensionMember& m, const ForceCurve& bond, double spacing,
                     double stress) {
  double low = 0.0, high = stress;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    const bool too_much = integrate_chain(m, bond, 0.5 * spacing, middle, stress).stress > stress;
    (too_much ? high : low) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

double chain_mean_strain(const TensionMember& m, const ForceCurve& bond, double spacing,
                         double stress) {
  const double middle = middle_stress(m, bond, spacing, stress);
  return integrate_chain(m, bond, 0.5 * spacing, middle, stress).mean_strain;
}

double chain_largest_spacing(const TensionMember& m, const ForceCurve& bond, double stress) {
  double low = 1.0, high = 2000.0;
  for (int k = 0; k < 40; ++k) {
    const double spacing = 0.5 * (low + high);
    const double concrete = m.ratio() * (stress - middle_stress(m, bond, spacing, stress));
    (concrete > m.strength ? high : low) = spacing;
  }
  return 0.5 * (low + high);
}

PullOut pull_long_bar(const ForceCurve& bond, double diameter, double steel, double length,
                      double motion) {
  const double area = 0.25 * std::numbers::pi * diameter * diameter;
  const double perimeter = std::numbers::pi * diameter;
  const int steps = 1000;
  const double dx = length / steps;
  PullOut result;
  double last_force = 0.0, last_slip = 0.0;
  for (double free_slip = 1e-8; last_slip < motion;
       free_slip += 1e-8 + 0.02 * std::min(free_slip, 0.05)) {
    double slip = free_slip, force = 0.0;
    for (int k = 0; k < steps; ++k) {
      const double middle = slip + 0.5 * dx * force / (steel * area);
      force += dx * perimeter * bond.force(middle);
      slip = middle + 0.5 * dx * force / (steel * area);
    }
    result.peak = std::max(result.peak, force);
    const double end = std::min(slip, motion);
    const double part = slip > last_slip ? (end - last_slip) / (slip - last_slip) : 0.0;
    const double force_end = last_force + part * (force - last_force);
    result.work += 0.5 * (last_force + force_end) * (end - last_slip);
    last_force = force;
    last_slip = slip;
  }
  return result;
}

}  // namespace perilink::verification
