#include "results/calibration_text.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/small_networks.hpp"

namespace perilink {
namespace {

using namespace test;

TEST(CalibrationText, TellsWhatWasReached) {
  CalibrationReport report;
  EXPECT_EQ(calibration_line(report), "no bond had to change");
  report.free_bonds = 120;
  report.residual_before = 0.31;
  report.residual_after = 2e-13;
  report.smallest_weight = 0.25;
  report.largest_weight = 3.5;
  EXPECT_EQ(calibration_line(report),
            "120 bonds, forces out of balance 0.31 before, 2.0e-13 after, weights 0.25 to 3.5");
  report.at_least_weight = 4;
  report.dropped = 2;
  EXPECT_NE(calibration_line(report).find(", 4 at the floor, 2 left out"), std::string::npos);
  EXPECT_EQ(calibration_json(report)["bonds_left_out"], 2);
  EXPECT_EQ(calibration_json(report)["residual_after"], 2e-13);
}

TEST(CalibrationText, TellsWhereItFellShort) {
  Network network = make_network({"", Pattern::rectangular, Surface::calibrated}, 8);
  ASSERT_TRUE(network.report.calibration.has_value());
  EXPECT_FALSE(calibration_shortfall(network).has_value());
  network.report.calibration->unmet = 3;
  network.report.calibration->residual_after = 0.004;
  network.report.calibration->worst_particle = 0;
  const std::string text = calibration_shortfall(network).value_or("");
  EXPECT_NE(text.find("3 particles"), std::string::npos);
  EXPECT_NE(text.find("4.0e-03"), std::string::npos);
  EXPECT_NE(text.find("at (0, 0)"), std::string::npos) << text;
  EXPECT_EQ(text.find("WARNING"), std::string::npos) << text;
  network.report.calibration->moment_after = 0.02;
  const std::string warning = calibration_shortfall(network).value_or("");
  EXPECT_NE(warning.find("2.0e-02"), std::string::npos) << warning;
  EXPECT_NE(warning.find("WARNING"), std::string::npos) << warning;
  network.report.calibration.reset();
  EXPECT_FALSE(calibration_shortfall(network).has_value());
}

}  // namespace
}  // namespace perilink
