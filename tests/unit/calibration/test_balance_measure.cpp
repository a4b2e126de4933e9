#include "calibration/balance_measure.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace perilink {
namespace {

/// Three particles on a line, at 0, 1 and 3.
ParticleScales line_scales() {
  Bonds bonds;
  bonds.append(0, 1, 1.0, std::array{1.0, 0.0});
  bonds.append(1, 2, 2.0, std::array{1.0, 0.0});
  return measure_particles(bonds, std::array{2.0, 3.0}, 3);
}

TEST(BalanceMeasure, ScalesAreModuliAndMeanLengths) {
  const ParticleScales scales = line_scales();
  EXPECT_EQ(scales.modulus, (std::vector{1.0, 7.0, 6.0}));  // 1/2 sum k xi^2
  EXPECT_EQ(scales.length, (std::vector{1.0, 1.75, 2.0}));  // over 1/2 sum k xi
}

TEST(BalanceMeasure, ReportsTheLargestOfTheParticlesThatCount) {
  const ForceRows rows{2, true};
  const auto count = static_cast<std::size_t>(rows.count());
  std::vector<double> rest(3 * count, 0.0);
  rest[0] = 100.0;                                               // nobody asks for the first
  rest[count + 1] = -4.0;                                        // a force
  rest[2 * count + static_cast<std::size_t>(rows.odd())] = 3.0;  // a moment
  CalibrationReport report;
  report_balance(rows, rest, std::array{Index{1}, Index{2}}, line_scales(), report);
  EXPECT_DOUBLE_EQ(report.residual_after, 4.0 * 1.75 / 7.0);
  EXPECT_DOUBLE_EQ(report.moment_after, 3.0 / 6.0);
  EXPECT_DOUBLE_EQ(report.sum_after, 1.5);
  EXPECT_EQ(report.worst_particle, 1);
  EXPECT_EQ(report.unmet, 2);
  rest[2 * count] = std::numeric_limits<double>::quiet_NaN();
  report_balance(rows, rest, std::array{Index{1}, Index{2}}, line_scales(), report);
  EXPECT_TRUE(std::isinf(report.residual_after)) << "a number that is none is no balance";
  EXPECT_EQ(report.worst_particle, 2);
}

TEST(BalanceMeasure, ReportsWeightsOfFreeBonds) {
  CalibrationReport report;
  for (int again = 0; again < 2; ++again) {
    report_weights(std::array{Index{0}, Index{1}, Index{3}}, std::array{0.0, 0.04, 99.0, 6.0},
                   std::array{1.0, 2.0, 1.0, 2.0}, 0.02, report);
    EXPECT_EQ(report.free_bonds, 3);
    EXPECT_EQ(report.dropped, 1);
    EXPECT_EQ(report.at_least_weight, 1);
    EXPECT_EQ(report.smallest_weight, 0.02);
    EXPECT_EQ(report.largest_weight, 3.0);
  }
}

}  // namespace
}  // namespace perilink
