#include "material/strength/random_field.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace perilink {
namespace {

struct Moments {
  double mean, deviation, least;
};

/// Moments of a function of a standard normal variable, by the rule of Simpson over ±8.
Moments moments_of(const UnitMean& factor_of) {
  constexpr int intervals = 4000;
  constexpr double most = 8.0, step = 2.0 * most / intervals;
  double mean = 0.0, square = 0.0, least = 1e300;
  for (int k = 0; k <= intervals; ++k) {
    const double z = -most + step * k;
    const double weight = (k == 0 || k == intervals ? 1.0
                           : k % 2 == 1             ? 4.0
                                                    : 2.0) *
                          step / 3.0 * std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi);
    const double value = factor_of(z);
    mean += weight * value;
    square += weight * value * value;
    least = std::min(least, value);
  }
  return {mean, std::sqrt(square - mean * mean), least};
}

TEST(RandomField, FactorsHaveUnitMeanTheirVariationAndAreAboveZero) {
  for (const Distribution distribution :
       {Distribution::normal, Distribution::lognormal, Distribution::weibull}) {
    for (const double variation : {0.001, 0.1, 0.3, 1.0}) {
      if (distribution == Distribution::normal && variation > most_normal_variation) continue;
      const Moments moments = moments_of(UnitMean(distribution, variation));
      // Errors of the rule and of the tails beyond it.
      EXPECT_NEAR(moments.mean, 1.0, 1e-9) << variation;
      EXPECT_NEAR(moments.deviation, variation, 1e-6 * variation + 1e-9) << variation;
      EXPECT_GT(moments.least, 0.0) << variation;
    }
  }
}

/// Closed forms: a Weibull variable of variation 1 is exponential, with the median ln 2; the median
/// of a lognormal one is 1 / sqrt(1 + v^2); a normal one is even about 1, cut off at 3 v / 0.98658.
TEST(RandomField, FactorsHaveTheirMedians) {
  EXPECT_NEAR(UnitMean(Distribution::weibull, 1.0)(0.0), std::numbers::ln2, 1e-12);
  EXPECT_NEAR(UnitMean(Distribution::lognormal, 0.5)(0.0), 1.0 / std::sqrt(1.25), 1e-12);
  const UnitMean normal(Distribution::normal, 0.2);
  EXPECT_EQ(normal(0.0), 1.0);
  EXPECT_NEAR(normal(1.3) + normal(-1.3), 2.0, 1e-15);
  EXPECT_NEAR(normal(9.0), 1.0 + 0.2 * 3.0 / 0.98658, 1e-5);
}

std::vector<double> at_points(const RandomField& field, const std::vector<double>& positions) {
  std::vector<Index> own;
  for (Index i = 0; i < static_cast<Index>(positions.size() / 2); ++i) own.push_back(i);
  return normal_field(field, positions, 2, own, own);
}

/// Estimates from n independent seeds differ from the mean by 4 standard deviations at most: of a
/// mean 1 / sqrt(n), of a variance sqrt(2 / n), of a correlation (1 + r^2)^(1/2) / sqrt(n).
TEST(RandomField, HasZeroMeanUnitVarianceAndItsCorrelationOverTheSeeds) {
  constexpr int seeds = 4000;
  const double limit = 4.0 / std::sqrt(seeds);
  const std::vector<double> positions = {7, -2, 7 + 1.5, -2, 7, -2 + 3, 7 + 2.4, -2 + 1.8};
  const double distances[] = {0.0, 1.5, 3.0, 3.0};
  double mean = 0.0;
  double products[4] = {};
  RandomField field;
  field.correlation_length = 3.0;
  for (field.seed = 1; field.seed <= seeds; ++field.seed) {
    const std::vector<double> z = at_points(field, positions);
    mean += z[0] / seeds;
    for (int k = 0; k < 4; ++k) products[k] += z[0] * z[k] / seeds;
  }
  EXPECT_NEAR(mean, 0.0, limit);
  for (int k = 0; k < 4; ++k) {
    const double expected = std::exp(-std::pow(distances[k] / 3.0, 2));
    EXPECT_NEAR(products[k], expected, limit * std::sqrt(1.0 + expected * expected)) << k;
  }
}

TEST(RandomField, FollowsFromTheSeedAlone) {
  const std::vector<double> positions = {0, 0, 1, 2, 30, 4};
  RandomField field;
  const std::vector<double> once = at_points(field, positions);
  EXPECT_EQ(at_points(field, positions), once);
  field.seed = 2;
  const std::vector<double> other = at_points(field, positions);
  for (std::size_t k = 0; k < once.size(); ++k) EXPECT_GT(std::abs(other[k] - once[k]), 1e-3);
}

TEST(RandomField, IsThatOfThePointInTheMiddleOfAPair) {
  const std::vector<double> positions = {0, 0, 0, 4, 2, 6, 2, 1, 3};
  const std::vector<Index> first = {0, 1, 2}, second = {1, 0, 2};
  const std::vector<double> z = normal_field({}, positions, 3, first, second);
  EXPECT_NEAR(z[0], z[2], 1e-13);
  EXPECT_NEAR(z[1], z[2], 1e-13);
}

}  // namespace
}  // namespace perilink
