// Bonds of all directions with the law of concrete under uniform strain, compared with curves of an
// independent integration.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "material/softening.hpp"
#include "support/concrete_curves.hpp"

namespace perilink {
namespace {

using namespace test;

constexpr double modulus = 24850.0, ratio = 0.22;

/// Number of directions with fine segments: errors of 0.1 % of the peak before it and 0.9 % beyond,
/// where directions fail one after another.
constexpr int directions = 360;
constexpr double overshoot = 0.005;

std::vector<CellBond> cell_of(Problem constants) {
  const double mu = 0.5 * modulus / (1.0 + ratio);
  const double lambda = constants == Problem::plane_stress
                            ? modulus * ratio / (1.0 - ratio * ratio)
                            : modulus * ratio / ((1.0 + ratio) * (1.0 - 2.0 * ratio));
  // Weights with the sum w and the shear ratio q give mu = w (1 + q) / 8 and lambda = w (1 - q) /
  // 8.
  std::vector<CellBond> cell;
  for (int i = 0; i < directions; ++i) {
    const double angle = (i + 0.5) * std::numbers::pi / directions;
    cell.push_back({{std::cos(angle), std::sin(angle), 0.0},
                    4.0 * (lambda + mu) / directions,
                    (mu - lambda) / (mu + lambda)});
  }
  return cell;
}

std::vector<CellPoint> path_of(const ConcretePoint& point) {
  const SofteningShape shape{Softening::concrete};
  const SofteningCurve tension(shape, softening_energy(shape, 2.0));
  const SofteningCurve compression(shape, softening_energy(shape, 3.0));
  const BondLaw law =
      saw_tooth_of(tension, overshoot)
          .crushing(segments_of(compression, overshoot), 0.001 / 0.00014, point.keeps_shear);
  return cell_path(cell_of(point.constants), 2, {{1.0, 0.0, 0.0}, point.strain < 0.0, point.across},
                   law, 0.00014);
}

double peak_of(const std::vector<CellPoint>& path) {
  double peak = 0.0;
  for (const CellPoint& point : path) peak = std::max(peak, point.stress);
  return peak;
}

TEST(ConcreteCells, FollowTheCurvesOfTheLaw) {
  constexpr std::size_t points_of_curve = 5, place_of_peak = 3;
  for (std::size_t k = 0; k < std::size(concrete_points); k += points_of_curve) {
    const std::vector<CellPoint> path = path_of(concrete_points[k]);
    const ConcretePoint& highest = concrete_points[k + place_of_peak];
    EXPECT_NEAR(peak_of(path), std::abs(highest.stress), 0.003 * std::abs(highest.stress)) << k;
    for (std::size_t j = k; j < k + points_of_curve; ++j) {
      const ConcretePoint& point = concrete_points[j];
      // At the strain of the peak the force of the bonds in the loading direction drops at once.
      const double strain = std::abs(point.strain) * (j == k + place_of_peak ? 0.998 : 1.0);
      EXPECT_NEAR(stress_at(path, strain), std::abs(point.stress), 0.01 * std::abs(highest.stress))
          << "strain " << point.strain << " of curve " << k / points_of_curve;
    }
  }
}

/// Without tension all bonds stay inactive.
TEST(ConcreteCells, StayElasticWhereNothingIsPulled) {
  EXPECT_TRUE(path_of({Problem::plane_stress, true, Across::held, -1.0, 0.0}).empty());
}

/// Where bonds do not shear, the path equals the path of a law with equal segments in tension only.
TEST(ConcreteCells, AgreeWithOtherLawsInTension) {
  const std::vector<CellBond> cell = isotropic_cell(Problem::plane_stress, 1.0);
  const SofteningShape shape{Softening::concrete};
  const BondLaw law = saw_tooth_of(SofteningCurve(shape, softening_energy(shape, 2.0)), 0.02);
  const double unit = 2e-4 * cell_modulus(cell, 2, {1.0, 0.0, 0.0});
  const double expected = cell_strength(cell, 2, {1.0, 0.0, 0.0}, law) * unit;
  const BondLaw both = law.crushing({{1.0, 1.0}}, 1e6, true);
  for (const BondLaw& each : {law, both}) {
    EXPECT_NEAR(peak_of(cell_path(cell, 2, {{1.0, 0.0, 0.0}}, each, 2e-4)), expected,
                1e-9 * expected);
  }
}

}  // namespace
}  // namespace perilink
