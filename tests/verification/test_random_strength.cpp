// Bodies whose strength scatters fail in their weakest place.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "material/strength/random_field.hpp"
#include "support/whole_run.hpp"

namespace perilink::verification {
namespace {

/// A strip 200 by 20 in tension along x with unbreakable ends. Its strength varies over 40, more
/// than its width and the horizon of 12.
std::string random_strip(int seed) {
  return R"(title = "Strip of random strength"
[body]
problem = "plane_stress"
spacing = 4
horizon_ratio = 3
[[regions]]
name = "strip"
x = [0, 200]
y = [0, 20]
[[regions]]
name = "left"
x = [0, 20]
y = [0, 20]
[[regions]]
name = "right"
x = [180, 200]
y = [0, 20]
[[materials]]
name = "concrete"
region = "strip"
youngs_modulus = 30000
fracture_energy = 0.1
tensile_strength = 3
softening = "linear"
[[materials]]
name = "ends"
regions = ["left", "right"]
youngs_modulus = 30000
fracture_energy = "infinite"
[[random]]
property = "tensile_strength"
distribution = "weibull"
variation = 0.15
correlation_length = 40
seed = )" +
         std::to_string(seed) + R"(
[[supports]]
region = "left"
fix = ["x", "y"]
[[displacements]]
region = "right"
x = 1
[stop]
load_fraction = 0.1
)";
}

/// Strengths along the axis of the strip, a horizon and more away from its unbreakable ends.
struct Axis {
  double least = 1e300, place = 0.0;  ///< weakest place and its strength
  double mean = 0.0;
};

Axis strengths_along(const RandomField& field) {
  std::vector<double> positions;
  std::vector<Index> points;
  for (Index x = 32; x <= 168; ++x) {
    positions.insert(positions.end(), {static_cast<double>(x), 10.0});
    points.push_back(x - 32);
  }
  const std::vector<double> z = normal_field(field, positions, 2, points, points);
  const UnitMean factor_of(field.distribution, field.variation);
  Axis axis;
  for (std::size_t k = 0; k < z.size(); ++k) {
    const double strength = 3.0 * factor_of(z[k]);
    axis.mean += strength / static_cast<double>(z.size());
    if (strength < axis.least) {
      axis.least = strength;
      axis.place = positions[2 * k];
    }
  }
  return axis;
}

/// Returns the mean x of the points with half of the largest damage or more.
double place_of_crack(const test::WholeRun& run) {
  const VtuGrid fields = run.fields(run.series().size() - 1);
  const std::vector<double>& damage = fields.find_point_data("damage")->values;
  const double half = 0.5 * *std::max_element(damage.begin(), damage.end());
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < damage.size(); ++i) {
    if (damage[i] < half) continue;
    sum += fields.points[3 * i];
    count += 1.0;
  }
  return sum / count;
}

TEST(RandomStrength, AStripBreaksInItsWeakestPlaceAtItsStrength) {
  for (const int seed : {1, 2, 3, 4, 5, 6}) {
    const test::WholeRun run(random_strip(seed));
    const Axis axis = strengths_along(run.input.fields.random[0].field);
    const double peak = run.summary.json.at("peak_load").get<double>();
    // The crack has the strength of its surroundings within a horizon and the width of the strip,
    // which is more than that of the weakest place of its axis.
    EXPECT_NEAR(peak / (20.0 * axis.least), 1.04, 0.06) << seed;
    EXPECT_LT(peak, 0.95 * 20.0 * axis.mean) << seed;
    EXPECT_NEAR(place_of_crack(run), axis.place, 12.0) << seed;
  }
}

}  // namespace
}  // namespace perilink::verification
