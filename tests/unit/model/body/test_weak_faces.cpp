#include "model/body/weak_faces.hpp"

#include <gtest/gtest.h>

#include "model/from_case/configure.hpp"
#include "support/strip_case.hpp"

namespace perilink {
namespace {

using namespace test;

CaseFile case_with(const std::string& section) {
  return parse_case(strip_text + std::string("\n[[interfaces]]\n") + section, "strip.toml");
}

/// The strip has 5 columns and 9 rows of particles 10 apart, and a horizon of 3.1.
TEST(WeakFaces, AreWhereRegionsMeet) {
  const CaseFile input =
      case_with("between = [\"strip\", \"upper end\"]\nfracture_energy = 0.002\n");
  const Model model = build_model(input);
  ASSERT_EQ(model.network.report.interfaces.size(), 1u);
  const Network& network = model.network;
  Index crossing = 0;
  for (Index e = 0; e < network.num_bonds(); ++e) {
    const double from = network.particles.position(network.bonds.first[e])[1];
    const double to = network.particles.position(network.bonds.second[e])[1];
    const bool crosses = (from < 59.0) != (to < 59.0);  // a particle at 60 is of the upper end
    crossing += crosses;
    EXPECT_EQ(network.critical_stretch[e] == network.critical_stretch[0], !crosses) << e;
  }
  EXPECT_EQ(network.report.interfaces[0].count, crossing);
}

TEST(WeakFaces, AreTheSameByALine) {
  const Model regions =
      build_model(case_with("between = [\"strip\", \"upper end\"]\nfracture_energy = 0.002\n"));
  const Model line =
      build_model(case_with("points = [[-5, 55], [45, 55]]\nfracture_energy = 0.002\n"));
  EXPECT_EQ(line.network.report.interfaces[0].count, regions.network.report.interfaces[0].count);
  EXPECT_EQ(line.network.critical_stretch, regions.network.critical_stretch);
}

TEST(WeakFaces, AreLeftOutOfElasticAnalyses) {
  CaseFile input = case_with("points = [[-5, 55], [45, 55]]\nfracture_energy = 0.002\n");
  input.analysis.type = AnalysisType::elastic;
  EXPECT_TRUE(build_model(input).network.report.interfaces.empty());
}

TEST(WeakFaces, AreRefusedWhereNoBondCrossesThem) {
  expect_refused(case_with("between = [\"lower end\", \"upper end\"]\nfracture_energy = 1\n"),
                 "interfaces[1].between", "with particles between them");
  expect_refused(case_with("points = [[90, 0], [95, 0]]\nfracture_energy = 1\n"),
                 "interfaces[1].points", "crosses no bond");
  expect_refused(case_with("points = [[9, 0], [9, 0]]\nfracture_energy = 1\n"),
                 "interfaces[1].points", "two equal points");
}

TEST(WeakFaces, AreRefusedWhereBondsWouldHoldTooMuch) {
  expect_refused(
      case_with("points = [[-5, 55], [45, 55]]\nfracture_energy = 1e-5\ntensile_strength = 1\n"),
      "interfaces[1].tensile_strength", "take a horizon below");
}

}  // namespace
}  // namespace perilink
